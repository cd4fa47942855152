// UNTESTED: neither compiled nor run. All solutions of a pose by P/Invoke, .NET 6 or newer:
// irbkin.dll, libirbkin.so or libirbkin.dylib is beside the program, or where the loader finds it.
using System;
using System.Runtime.InteropServices;

/// A robot that is freed with its handle.
internal sealed class Robot : SafeHandle
{
    private Robot() : base(IntPtr.Zero, true) { }

    public override bool IsInvalid => handle == IntPtr.Zero;

    protected override bool ReleaseHandle()
    {
        Native.irbkin_robot_free(handle);
        return true;
    }

    public static Robot Named(string name)
    {
        Native.Check(Native.irbkin_robot_named(name, out Robot robot));
        return robot;
    }

    public int Dof => (int)Native.irbkin_robot_dof(this);

    public int SlotCount => (int)Native.irbkin_robot_slot_count(this);

    /// Every solution of a 4x4 pose by rows [m]: rows of joint angles [rad], NaN in an empty slot.
    public (double[] Q, byte[] Status) Ik(double[] pose)
    {
        // The library cannot see how long the array is.
        if (pose.Length != 16) throw new ArgumentException("pose must have 16 elements");
        var q = new double[SlotCount * Dof];
        var status = new byte[SlotCount];
        Native.Check(Native.irbkin_ik(this, pose, null, q, (nuint)q.Length, status,
            (nuint)status.Length, out _));
        return (q, status);
    }
}

internal static class Native
{
    private const string Library = "irbkin";

    [DllImport(Library)]
    internal static extern int irbkin_robot_named(
        [MarshalAs(UnmanagedType.LPUTF8Str)] string name, out Robot robot);

    [DllImport(Library)]
    internal static extern void irbkin_robot_free(IntPtr robot);

    [DllImport(Library)]
    internal static extern nuint irbkin_robot_dof(Robot robot);

    [DllImport(Library)]
    internal static extern nuint irbkin_robot_slot_count(Robot robot);

    [DllImport(Library)]
    internal static extern int irbkin_ik(Robot robot, double[] pose, double[] q7, [Out] double[] q,
        nuint qLen, [Out] byte[] status, nuint statusLen, out nuint found);

    [DllImport(Library)]
    private static extern IntPtr irbkin_last_error();

    /// Throw the message of a call that failed. It is of this thread, and await may change threads:
    /// nothing is awaited in between.
    internal static void Check(int code)
    {
        if (code != 0)
            throw new InvalidOperationException(Marshal.PtrToStringUTF8(irbkin_last_error()));
    }
}

internal static class Program
{
    private static void Main()
    {
        using Robot robot = Robot.Named("IRB 2600-12/1.65");
        double[] pose = { 1, 0, 0, 0.85, 0, -1, 0, 0.32, 0, 0, -1, 0.64, 0, 0, 0, 1 };
        var (q, status) = robot.Ik(pose);
        for (int slot = 0; slot < status.Length; slot++)
        {
            if ((status[slot] & 1) == 0) continue;
            var angles = new ArraySegment<double>(q, slot * robot.Dof, robot.Dof);
            Console.WriteLine($"slot {slot}: {string.Join(" ", angles)}");
        }
    }
}
