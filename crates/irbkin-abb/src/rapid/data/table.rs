//! RAPID's own instructions and functions: their arguments, and what they do to motion.

use super::instructions::Effect::{
    self, Displaces, Jumps, Leaves, Moves, Nothing, Offsets, Returns, Sets, Stops, Waits,
};
use super::instructions::Shift::{Between, Given, Off};
use super::moves::MoveKind::{self, MoveAbsJ, MoveC, MoveExtJ, MoveJ, MoveL};
use super::moving::{
    AFTER, ALONG, EXTERNAL, Layout, MoveInstruction, PLAIN, SEARCH, SEARCH_EXTERNAL, STOPS, THEN,
};

/// An instruction or a function of RAPID.
#[doc(hidden)]
pub struct Entry {
    pub(crate) name: &'static str,
    /// The arguments as the header of a routine has them. `...` is for others, which are not known:
    /// any number behind a comma, options behind a backslash.
    pub(crate) arguments: &'static str,
    pub(crate) effect: Effect,
    pub(crate) movement: Option<MoveInstruction>,
    pub(crate) is_function: bool,
}

const fn does(name: &'static str, arguments: &'static str, effect: Effect) -> Entry {
    Entry { name, arguments, effect, movement: None, is_function: false }
}

const fn call(name: &'static str, arguments: &'static str) -> Entry {
    does(name, arguments, Nothing)
}

const fn function(name: &'static str, arguments: &'static str) -> Entry {
    Entry { is_function: true, ..call(name, arguments) }
}

const fn goes(name: &'static str, way: MoveKind, layout: Layout, arguments: &'static str) -> Entry {
    let movement = Some(MoveInstruction { name, way, layout });
    Entry { movement, ..call(name, arguments) }
}

#[rustfmt::skip]
macro_rules! to { () => { r"robtarget ToPoint\identno ID,speeddata Speed" }; }
#[rustfmt::skip]
macro_rules! via { () => { concat!("robtarget CirPoint,", to!()) }; }
#[rustfmt::skip]
macro_rules! joints { () => { r"jointtarget ToJointPos\identno ID,speeddata Speed" }; }
#[rustfmt::skip]
macro_rules! with { () => { r",tooldata Tool\wobjdata WObj\..." }; }
#[rustfmt::skip]
macro_rules! meets { () => { concat!(with!(), ",...") }; }
#[rustfmt::skip]
macro_rules! at { () => { concat!(",zonedata Zone", with!()) }; }
#[rustfmt::skip]
macro_rules! more { () => { concat!(",zonedata Zone", meets!()) }; }

/// Sorted by their names in lower case. Sources: the RAPID reference manual; the application manuals
/// of arc and spot welding, dispensing, painting, Continuous Application Platform, Externally Guided
/// Motion and force control.
#[rustfmt::skip]
static TABLE: &[Entry] = &[
    function("Abs", "num Value"),
    call("AccSet", r"num Acc,num Ramp\num FinePointRamp"),
    function("ACos", "num Value"),
    call("ActUnit", "mecunit MechUnit"),
    call("Add", "INOUT num Name,num AddValue"),
    function("AInput", "signalai Signal"),
    call("AliasIO", "signal FromSignal,signal ToSignal"),
    call("AliasIOReset", "signal Signal"),
    function("AOutput", "signalao Signal"),
    goes("ArcAdaptC", MoveC, ALONG, concat!(via!(), ",...", more!())),
    goes("ArcAdaptCEnd", MoveC, ALONG, concat!(via!(), ",...", more!())),
    goes("ArcAdaptL", MoveL, ALONG, concat!(to!(), ",...", more!())),
    goes("ArcAdaptLEnd", MoveL, ALONG, concat!(to!(), ",...", more!())),
    goes("ArcAdaptLStart", MoveL, ALONG, concat!(to!(), ",...", more!())),
    does("ArcAdaptRepL", "...", Moves),
    goes("ArcC", MoveC, ALONG, concat!(via!(), ",seamdata Seam,welddata Weld", more!())),
    goes("ArcCalcC", MoveC, ALONG, concat!(via!(), ",seamdata Seam,welddata Weld", more!())),
    goes("ArcCalcCEnd", MoveC, ALONG, concat!(via!(), ",seamdata Seam,welddata Weld", more!())),
    goes("ArcCalcL", MoveL, ALONG, concat!(to!(), ",seamdata Seam,welddata Weld", more!())),
    goes("ArcCalcLEnd", MoveL, ALONG, concat!(to!(), ",seamdata Seam,welddata Weld", more!())),
    goes("ArcCalcLStart", MoveL, ALONG, concat!(to!(), ",seamdata Seam,welddata Weld", more!())),
    goes("ArcCEnd", MoveC, ALONG, concat!(via!(), ",seamdata Seam,welddata Weld", more!())),
    goes("ArcCStart", MoveC, ALONG, concat!(via!(), ",seamdata Seam,welddata Weld", more!())),
    goes("ArcL", MoveL, ALONG, concat!(to!(), ",seamdata Seam,welddata Weld", more!())),
    goes("ArcLEnd", MoveL, ALONG, concat!(to!(), ",seamdata Seam,welddata Weld", more!())),
    goes("ArcLStart", MoveL, ALONG, concat!(to!(), ",seamdata Seam,welddata Weld", more!())),
    goes("ArcMoveAbsJ", MoveAbsJ, PLAIN, concat!(joints!(), at!())),
    goes("ArcMoveC", MoveC, PLAIN, concat!(via!(), at!())),
    goes("ArcMoveExtJ", MoveExtJ, EXTERNAL, concat!(joints!(), ",zonedata Zone,...")),
    goes("ArcMoveJ", MoveJ, PLAIN, concat!(to!(), at!())),
    goes("ArcMoveL", MoveL, PLAIN, concat!(to!(), at!())),
    does("ArcRepL", "...", Moves),
    function("ArgName", r"anytype Parameter\errnum ErrorNumber"),
    function("ASin", "num Value"),
    function("ATan", "num Value"),
    function("ATan2", "num Y,num X"),
    function("BitAnd", "byte BitData1,byte BitData2"),
    function("BitCheck", "byte BitData,num BitPos"),
    call("BitClear", "INOUT byte BitData,num BitPos"),
    function("BitLSh", "byte BitData,num ShiftSteps"),
    function("BitNeg", "byte BitData"),
    function("BitOr", "byte BitData1,byte BitData2"),
    function("BitRSh", "byte BitData,num ShiftSteps"),
    call("BitSet", "INOUT byte BitData,num BitPos"),
    function("BitXOr", "byte BitData1,byte BitData2"),
    call("BookErrNo", "INOUT errnum ErrorName"),
    does("Break", "", Stops),
    function("ByteToStr", r"byte BitData\switch Hex|switch Okt|switch Bin|switch Char"),
    function("CalcJointT", r"\switch UseCurWObjPos,robtarget Rob_Target,tooldata Tool\wobjdata WObj\..."),
    function("CalcRobT", r"jointtarget Joint_Target,tooldata Tool\wobjdata WObj\..."),
    goes("CalibJ", MoveJ, STOPS, concat!(to!(), ",...", meets!())),
    goes("CalibL", MoveL, STOPS, concat!(to!(), ",...", meets!())),
    call("CallByVar", "string Name,num Number"),
    call("CamFlush", "cameradev Camera"),
    function("CamGetExposure", r"cameradev Camera\..."),
    function("CamGetLoadedJob", "cameradev Camera"),
    function("CamGetMode", "cameradev Camera"),
    function("CamGetName", "cameradev Camera"),
    call("CamGetParameter", r"cameradev Camera,string ParName\..."),
    call("CamGetResult", r"cameradev Camera,INOUT cameratarget CamTarget\..."),
    call("CamLoadJob", r"cameradev Camera,string JobName\..."),
    function("CamNumberOfResults", r"cameradev Camera\..."),
    call("CamReqImage", r"cameradev Camera\..."),
    call("CamSetExposure", r"cameradev Camera\..."),
    call("CamSetParameter", r"cameradev Camera,string ParName\..."),
    call("CamSetProgramMode", "cameradev Camera"),
    call("CamSetRunMode", "cameradev Camera"),
    call("CamStartLoadJob", r"cameradev Camera,string Name\..."),
    call("CamWaitLoadJob", "cameradev Camera"),
    call("CancelLoad", "INOUT loadsession LoadNo"),
    goes("CapC", MoveC, ALONG, concat!(via!(), ",capdata Cdata", more!())),
    goes("CapL", MoveL, ALONG, concat!(to!(), ",capdata Cdata", more!())),
    does("CirPathMode", r"\switch PathFrame|switch ObjectFrame|switch CirPointOri|switch Wrist45|switch Wrist46|switch Wrist56", Sets),
    function("CJointT", r"\taskid TaskRef|string TaskName"),
    call("Clear", "INOUT num Name"),
    call("ClearIOBuff", "iodev IODevice"),
    call("ClearRawBytes", r"INOUT rawbytes RawData\num FromIndex"),
    function("ClkRead", r"clock Clock\switch HighRes"),
    call("ClkReset", "INOUT clock Clock"),
    call("ClkStart", "INOUT clock Clock"),
    call("ClkStop", "INOUT clock Clock"),
    call("Close", "INOUT iodev IODevice"),
    call("CloseDir", "INOUT dir Dev"),
    does("ConfJ", r"\switch On|switch Off", Sets),
    does("ConfL", r"\switch On|switch Off", Sets),
    goes("ContactL", MoveL, STOPS, concat!(to!(), ",...", meets!())),
    does("CONTINUE", "", Jumps),
    call("CopyFile", "string OldPath,string NewPath"),
    call("CopyRawBytes", r"rawbytes FromRawData,num FromIndex,INOUT rawbytes ToRawData,num ToIndex\num NoOfBytes"),
    call("CorrCon", "INOUT corrdescr Descr"),
    call("CorrDiscon", "INOUT corrdescr Descr"),
    call("CorrWrite", "corrdescr Descr,pos Data"),
    function("Cos", "num Angle"),
    function("CPos", r"\tooldata Tool\wobjdata WObj"),
    function("CRobT", r"\taskid TaskRef|string TaskName\tooldata Tool\wobjdata WObj"),
    function("CrossProd", "pos Vector1,pos Vector2"),
    function("CSpeedOverride", r"\switch CTask"),
    goes("CSSDeactMoveL", MoveL, STOPS, concat!(to!(), ",...", meets!())),
    function("CTool", r"\taskid TaskRef|string TaskName"),
    function("CWObj", r"\taskid TaskRef|string TaskName"),
    goes("DaProcMJ", MoveJ, ALONG, concat!(to!(), ",...", more!())),
    goes("DaProcML", MoveL, ALONG, concat!(to!(), ",...", more!())),
    call("DeactUnit", "mecunit MechUnit"),
    call("Decr", "INOUT num Name"),
    function("DecToHex", "string Str"),
    function("DefDFrame", "robtarget OldP1,robtarget OldP2,robtarget OldP3,robtarget NewP1,robtarget NewP2,robtarget NewP3"),
    function("DefFrame", r"robtarget NewP1,robtarget NewP2,robtarget NewP3\num Origin"),
    function("Dim", "anytype ArrPar,num DimNo"),
    function("DInput", "signaldi Signal"),
    goes("DispC", MoveC, ALONG, concat!(via!(), ",beaddata Bead", more!())),
    goes("DispL", MoveL, ALONG, concat!(to!(), ",beaddata Bead", more!())),
    function("Distance", "pos Point1,pos Point2"),
    call("DitherAct", r"\mecunit MechUnit,num Axis,num Level"),
    function("DnumToNum", r"dnum Value\switch Integer"),
    function("DnumToStr", r"dnum Val,num Dec\switch Exp"),
    function("DotProd", "pos Vector1,pos Vector2"),
    function("DOutput", "signaldo Signal"),
    call("DropSensor", r"mecunit Obj\..."),
    call("DropWObj", r"wobjdata WObj\..."),
    function("EGMGetState", "egmident EGMid"),
    does("EGMMove", "...", Moves),
    goes("EGMMoveC", MoveC, AFTER, concat!("egmident EGMid,", via!(), more!())),
    goes("EGMMoveL", MoveL, AFTER, concat!("egmident EGMid,", to!(), more!())),
    does("EGMRun", "...", Moves),
    does("EOffsOff", "", Offsets(Off)),
    does("EOffsOn", r"\robtarget ExeP,robtarget ProgPoint", Offsets(Between)),
    does("EOffsSet", "extjoint EAxOffs", Offsets(Given)),
    call("EraseModule", "string ModuleName"),
    call("ErrLog", r"errnum ErrorId\switch W|switch I,..."),
    call("ErrRaise", "string ErrorName,num ErrorId,..."),
    call("ErrWrite", r"\switch W|switch I,string Header,string Reason\string RL2\string RL3\string RL4"),
    function("EulerZYX", r"\switch X|switch Y|switch Z,orient Rotation"),
    does("EXIT", "...", Leaves),
    does("ExitCycle", "", Leaves),
    function("Exp", "num Exponent"),
    does("FCPress", "...", Moves),
    goes("FCPress1LStart", MoveL, ALONG, concat!(to!(), ",...", more!())),
    goes("FCPressC", MoveC, ALONG, concat!(via!(), ",...", more!())),
    goes("FCPressEnd", MoveL, STOPS, concat!(to!(), ",...", meets!())),
    goes("FCPressL", MoveL, ALONG, concat!(to!(), ",...", more!())),
    function("FileSize", "string Path"),
    function("FileTime", r"string Path\..."),
    function("FSSize", r"string Name\..."),
    call("GetDataVal", r"string Object\datapos Block|taskid TaskRef|string TaskName,INOUT anytype Value"),
    call("GetJointData", r"\mecunit MechUnit,num Axis\..."),
    function("GetMecUnitName", "mecunit MechUnit"),
    function("GetMotorTorque", r"\mecunit MecUnit,num Axis"),
    function("GetNextSym", r"INOUT string Object,INOUT datapos Block\switch Recursive"),
    function("GetNumberOfCyclicBool", r"\..."),
    function("GetSignalOrigin", "signal Signal,INOUT string SignalName"),
    call("GetSysData", r"INOUT anytype DestObject\..."),
    function("GetSysInfo", r"\..."),
    function("GetTaskName", r"\num TaskNo|num MecTaskNo"),
    function("GetTime", r"\switch WDay|switch Hour|switch Min|switch Sec"),
    call("GetTrapData", "INOUT trapdata TrapEvent"),
    function("GInput", "signalgi Signal"),
    goes("GlueC", MoveC, ALONG, concat!(via!(), ",...", more!())),
    goes("GlueL", MoveL, ALONG, concat!(to!(), ",...", more!())),
    does("GOTO", "...", Jumps),
    function("GOutput", "signalgo Signal"),
    call("GripLoad", r"loaddata Load\..."),
    function("HexToDec", "string Str"),
    does("HR_ContMove", "...", Moves),
    does("HR_MoveBack", "...", Moves),
    does("HR_MoveRoutine", "...", Moves),
    does("HR_MoveTo", "...", Moves),
    does("HR_MoveToHome", "...", Moves),
    call("IDelete", "intnum Interrupt"),
    call("IError", r"errdomain ErrorDomain\num ErrorId,errtype ErrorType,intnum Interrupt"),
    call("Incr", "INOUT num Name"),
    call("IndAMove", r"mecunit MecUnit,num Axis\num ToAbsPos|num ToAbsNum,num Speed\num Ramp"),
    call("IndCMove", r"mecunit MecUnit,num Axis,num Speed\num Ramp"),
    call("IndDMove", r"mecunit MecUnit,num Axis,num Delta,num Speed\num Ramp"),
    function("IndInpos", "mecunit MecUnit,num Axis"),
    call("IndReset", r"mecunit MecUnit,num Axis\num RefPos|num RefNum\switch Short|switch Fwd|switch Bwd|switch Old"),
    call("IndRMove", r"mecunit MecUnit,num Axis\num ToRelPos|num ToRelNum\switch Short|switch Fwd|switch Bwd,num Speed\num Ramp"),
    function("IndSpeed", r"mecunit MecUnit,num Axis\switch InSpeed|switch ZeroSpeed"),
    call("InvertDO", "signaldo Signal"),
    call("IOBusStart", "string BusName"),
    call("IOBusState", r"string BusName,INOUT busstate State\switch Phys|switch Logic"),
    call("IODisable", "string UnitName,num MaxTime"),
    call("IOEnable", "string UnitName,num MaxTime"),
    function("IOUnitState", r"string UnitName\switch Phys|switch Logic"),
    call("IPers", r"\switch Single|switch SingleSafe,anytype Name,intnum Interrupt"),
    call("IRMQMessage", "anytype InterruptDataType,intnum Interrupt"),
    function("IsBrakeCheckActive", r"\..."),
    function("IsCyclicBool", "bool Flag"),
    function("IsFile", r"string Path\switch Directory\switch Fifo\switch RegFile\switch BlockSpec\switch CharSpec"),
    call("ISignalAI", r"\switch Single|switch SingleSafe,signalai Signal,aiotrigg Condition,num HighValue,num LowValue,num DeltaValue\switch DPos|switch DNeg,intnum Interrupt"),
    call("ISignalAO", r"\switch Single|switch SingleSafe,signalao Signal,aiotrigg Condition,num HighValue,num LowValue,num DeltaValue\switch DPos|switch DNeg,intnum Interrupt"),
    call("ISignalDI", r"\switch Single|switch SingleSafe,signaldi Signal,dionum TriggValue,intnum Interrupt"),
    call("ISignalDO", r"\switch Single|switch SingleSafe,signaldo Signal,dionum TriggValue,intnum Interrupt"),
    call("ISignalGI", r"\switch Single|switch SingleSafe,signalgi Signal,intnum Interrupt"),
    call("ISignalGO", r"\switch Single|switch SingleSafe,signalgo Signal,intnum Interrupt"),
    function("IsLeadThrough", r"\..."),
    call("ISleep", "intnum Interrupt"),
    function("IsMechUnitActive", "mecunit MechUnit"),
    function("IsPers", "anytype DatObj"),
    function("IsStopMoveAct", r"\switch FromMoveTask|switch FromNonMoveTask"),
    function("IsStopStateEvent", r"\switch PPMoved\switch PPToMain"),
    function("IsSysId", "string SystemId"),
    function("IsVar", "anytype DatObj"),
    call("ITimer", r"\switch Single|switch SingleSafe,num Time,intnum Interrupt"),
    call("IWatch", "intnum Interrupt"),
    call("Load", r"\switch Dynamic,string FilePath\string File\switch CheckRef"),
    call("MakeDir", "string Path"),
    function("Max", "num Value1,num Value2"),
    goes("MeasureWearL", MoveL, STOPS, concat!(to!(), ",...", meets!())),
    call("MechUnitLoad", "mecunit MechUnit,num AxisNo,loaddata Load"),
    function("Min", "num Value1,num Value2"),
    function("MirPos", r"robtarget Point,wobjdata MirPlane\wobjdata WObj\switch MirY"),
    function("ModExist", "string ModuleName"),
    function("ModTime", r"string Object\..."),
    call("MotionProcessModeSet", "motionprocessmode Mode"),
    call("MotionSup", r"\switch On|switch Off\num TuneValue\switch NoBackoff"),
    goes("MoveAbsJ", MoveAbsJ, PLAIN, r"\switch Conc,jointtarget ToJointPos\identno ID\switch NoEOffs,speeddata Speed\num V|num T,zonedata Zone\num Z\stoppointdata Inpos,tooldata Tool\wobjdata WObj\loaddata TLoad"),
    goes("MoveC", MoveC, PLAIN, concat!(r"\switch Conc,", via!(), r"\num V|num T,zonedata Zone\num Z\stoppointdata Inpos,tooldata Tool\wobjdata WObj\switch Corr\loaddata TLoad")),
    goes("MoveCAO", MoveC, THEN, concat!(via!(), r",zonedata Zone,tooldata Tool\wobjdata WObj\...,signalao Signal,num Value")),
    goes("MoveCDO", MoveC, THEN, concat!(via!(), r",zonedata Zone,tooldata Tool\wobjdata WObj\...,signaldo Signal,dionum Value")),
    goes("MoveCGO", MoveC, THEN, concat!(via!(), r",zonedata Zone,tooldata Tool\wobjdata WObj\...,signalgo Signal\num Value|dnum DValue")),
    goes("MoveCSync", MoveC, THEN, concat!(via!(), r",zonedata Zone,tooldata Tool\wobjdata WObj\...,string ProcName")),
    goes("MoveExtJ", MoveExtJ, EXTERNAL, r"\switch Conc,jointtarget ToJointPos\identno ID\switch UseEOffs,speeddata Speed\num T,zonedata Zone\stoppointdata Inpos"),
    goes("MoveJ", MoveJ, PLAIN, concat!(r"\switch Conc,", to!(), r"\num V|num T,zonedata Zone\num Z\stoppointdata Inpos,tooldata Tool\wobjdata WObj\loaddata TLoad")),
    goes("MoveJAO", MoveJ, THEN, concat!(to!(), r",zonedata Zone,tooldata Tool\wobjdata WObj\...,signalao Signal,num Value")),
    goes("MoveJDO", MoveJ, THEN, concat!(to!(), r",zonedata Zone,tooldata Tool\wobjdata WObj\...,signaldo Signal,dionum Value")),
    goes("MoveJGO", MoveJ, THEN, concat!(to!(), r",zonedata Zone,tooldata Tool\wobjdata WObj\...,signalgo Signal\num Value|dnum DValue")),
    goes("MoveJSync", MoveJ, THEN, concat!(to!(), r",zonedata Zone,tooldata Tool\wobjdata WObj\...,string ProcName")),
    goes("MoveL", MoveL, PLAIN, concat!(r"\switch Conc,", to!(), r"\num V|num T,zonedata Zone\num Z\stoppointdata Inpos,tooldata Tool\wobjdata WObj\switch Corr\loaddata TLoad")),
    goes("MoveLAO", MoveL, THEN, concat!(to!(), r",zonedata Zone,tooldata Tool\wobjdata WObj\...,signalao Signal,num Value")),
    goes("MoveLDO", MoveL, THEN, concat!(to!(), r",zonedata Zone,tooldata Tool\wobjdata WObj\...,signaldo Signal,dionum Value")),
    goes("MoveLGO", MoveL, THEN, concat!(to!(), r",zonedata Zone,tooldata Tool\wobjdata WObj\...,signalgo Signal\num Value|dnum DValue")),
    goes("MoveLSync", MoveL, THEN, concat!(to!(), r",zonedata Zone,tooldata Tool\wobjdata WObj\...,string ProcName")),
    does("MovePnP", "...", Moves),
    call("MToolRotCalib", r"jointtarget RefTip,jointtarget ZPos\jointtarget XPos,INOUT tooldata Tool"),
    call("MToolTCPCalib", "jointtarget Pos1,jointtarget Pos2,jointtarget Pos3,jointtarget Pos4,INOUT tooldata Tool,INOUT num MaxErr,INOUT num MeanErr"),
    function("NonMotionMode", r"\..."),
    function("NOrient", "orient Rotation"),
    function("NumToDnum", "num Value"),
    function("NumToStr", r"num Val,num Dec\switch Exp"),
    goes("NutJ", MoveJ, STOPS, concat!(to!(), ",...", meets!())),
    goes("NutL", MoveL, STOPS, concat!(to!(), ",...", meets!())),
    function("Offs", "robtarget Point,num XOffset,num YOffset,num ZOffset"),
    call("Open", r"string Object\string File,INOUT iodev IODevice\switch Read|switch Write|switch Append\switch Bin"),
    call("OpenDir", "INOUT dir Dev,string Path"),
    function("OrientZYX", "num ZAngle,num YAngle,num XAngle"),
    function("ORobT", r"robtarget OrgPoint\switch InPDisp|switch InEOffs"),
    call("PackDNHeader", "string Service,string Path,INOUT rawbytes RawData"),
    call("PackRawBytes", r"anytype Value,INOUT rawbytes RawData\switch Network,num StartIndex\switch Hex1|inttypes IntX|switch Float4|switch ASCII"),
    goes("PaintC", MoveC, ALONG, concat!(via!(), ",...", more!())),
    goes("PaintL", MoveL, ALONG, concat!(to!(), ",...", more!())),
    call("PathAccLim", r"bool AccLim\num AccMax,bool DecelLim\num DecelMax"),
    does("PathRecMoveBwd", r"\pathrecid ID\...", Moves),
    does("PathRecMoveFwd", r"\pathrecid ID\...", Moves),
    call("PathRecStart", "pathrecid ID"),
    call("PathRecStop", r"\switch Clear"),
    function("PathRecValidBwd", r"\pathrecid ID"),
    function("PathRecValidFwd", r"\pathrecid ID"),
    call("PathResol", "num Value"),
    // It adds to the displacement: which one is then not known.
    does("PDispAdd", "...", Displaces(Between)),
    does("PDispOff", "", Displaces(Off)),
    does("PDispOn", r"\switch Rot\robtarget ExeP,robtarget ProgPoint,tooldata Tool\wobjdata WObj", Displaces(Between)),
    does("PDispSet", "pose DispFrame", Displaces(Given)),
    function("PFRestart", r"\..."),
    function("PoseInv", "pose Pose"),
    function("PoseMult", "pose Pose1,pose Pose2"),
    function("PoseVect", "pose Pose,pos Position"),
    function("Pow", "num Base,num Exponent"),
    function("Present", "anytype OptPar"),
    call("ProcerrRecovery", r"\switch SyncOrgMoveInst|switch SyncLastMoveInst\switch ProcSignal"),
    call("PulseDO", r"\switch High\num PLength,signaldo Signal"),
    does("RAISE", "...", Leaves),
    call("RaiseToUser", r"\switch Continue|switch BreakOff\num ErrorNumber"),
    function("RawBytesLen", "rawbytes RawData"),
    call("ReadAnyBin", r"iodev IODevice,INOUT anytype Data\num Time"),
    function("ReadBin", r"iodev IODevice\num Time"),
    call("ReadCfgData", r"string InstancePath,string Attribute,INOUT anytype CfgData\num ListNo"),
    function("ReadDir", "dir Dev,INOUT string FileName"),
    call("ReadErrData", r"trapdata TrapEvent,INOUT errdomain ErrorDomain,INOUT num ErrorId,INOUT errtype ErrorType\..."),
    function("ReadMotor", r"\mecunit MecUnit,num Axis"),
    function("ReadNum", r"iodev IODevice\string Delim\num Time"),
    call("ReadRawBytes", r"iodev IODevice,INOUT rawbytes RawData\num Time"),
    function("ReadStr", r"iodev IODevice\string Delim\switch RemoveCR\switch DiscardHeaders\num Time\..."),
    function("ReadStrBin", r"iodev IODevice,num NoOfChars\num Time"),
    function("RelTool", r"robtarget Point,num Dx,num Dy,num Dz\num Rx\num Ry\num Rz"),
    call("RemoveAllCyclicBool", r"\..."),
    call("RemoveDir", "string Path"),
    call("RemoveFile", "string Path"),
    call("RenameFile", "string OldPath,string NewPath"),
    call("Reset", "signaldo Signal"),
    does("RETRY", "...", Leaves),
    does("RETURN", "...", Returns),
    call("Rewind", "iodev IODevice"),
    call("RMQFindSlot", "INOUT rmqslot Slot,string Name"),
    call("RMQGetMessage", "INOUT rmqmessage Message"),
    call("RMQGetMsgData", "rmqmessage Message,INOUT anytype Data"),
    call("RMQGetMsgHeader", r"rmqmessage Message\..."),
    function("RMQGetSlotName", "rmqslot Slot"),
    call("RMQReadWait", r"INOUT rmqmessage Message\num TimeOut"),
    call("RMQSendMessage", r"rmqslot Slot,anytype SendData\num UserDef"),
    function("Round", r"num Val\num Dec"),
    function("RunMode", r"\switch Main"),
    call("Save", r"\taskid TaskRef|string TaskName,string ModuleName\string FilePath\string File"),
    call("SaveCfgData", r"string FilePath\string File,cfgdomain Domain"),
    does("SCSSDeactMoveL", "...", Moves),
    does("Search_1D", "...", Moves),
    does("Search_Groove", "...", Moves),
    does("Search_Part", "...", Moves),
    goes("SearchC", MoveC, SEARCH, concat!(r"\switch Stop|switch PStop|switch SStop|switch Sup,signaldi Signal\...,INOUT robtarget SearchPoint,", via!(), with!())),
    goes("SearchExtJ", MoveExtJ, SEARCH_EXTERNAL, concat!(r"\switch Stop|switch PStop|switch SStop|switch Sup,signaldi Signal\...,INOUT jointtarget SearchJointPos,", joints!(), r"\...")),
    goes("SearchL", MoveL, SEARCH, concat!(r"\switch Stop|switch PStop|switch SStop|switch Sup,signaldi Signal\...,INOUT robtarget SearchPoint,", to!(), with!())),
    call("SenDevice", "string Device"),
    call("Set", "signaldo Signal"),
    call("SetAllDataVal", r"string Type\string TypeMod\string Object\switch Hidden,anytype Value"),
    call("SetAO", "signalao Signal,num Value"),
    call("SetDataSearch", r"string Type\..."),
    call("SetDataVal", r"string Object\datapos Block|taskid TaskRef|string TaskName,anytype Value"),
    call("SetDO", r"\num SDelay|switch Sync,signaldo Signal,dionum Value"),
    call("SetGO", r"\num SDelay,signalgo Signal,num Value"),
    call("SetLeadThrough", r"\..."),
    call("SetSysData", r"anytype SourceObject\..."),
    function("Sin", "num Angle"),
    does("SingArea", r"\switch Wrist|switch LockAxis4|switch Arm|switch Off", Sets),
    does("SMoveJ", "...", Moves),
    does("SMoveJDO", "...", Moves),
    does("SMoveJGO", "...", Moves),
    does("SMoveJSync", "...", Moves),
    does("SMoveL", "...", Moves),
    does("SMoveLDO", "...", Moves),
    does("SMoveLGO", "...", Moves),
    does("SMoveLSync", "...", Moves),
    does("SocketAccept", r"socketdev Socket,INOUT socketdev ClientSocket\string ClientAddress\num Time", Waits),
    call("SocketBind", "socketdev Socket,string LocalAddress,num LocalPort"),
    call("SocketClose", "socketdev Socket"),
    does("SocketConnect", r"socketdev Socket,string Address,num Port\num Time", Waits),
    call("SocketCreate", r"INOUT socketdev Socket\switch UDP"),
    function("SocketGetStatus", "socketdev Socket"),
    call("SocketListen", "socketdev Socket"),
    function("SocketPeek", "socketdev Socket"),
    does("SocketReceive", r"socketdev Socket\string Str|rawbytes RawData|byte Data\num ReadNoOfBytes\num NoRecBytes\num Time", Waits),
    does("SocketReceiveFrom", r"socketdev Socket\...,INOUT string RemoteAddress,INOUT num RemotePort\...", Waits),
    call("SocketSend", r"socketdev Socket\string Str|rawbytes RawData|byte Data\num NoOfBytes"),
    call("SocketSendTo", "socketdev Socket,..."),
    call("SoftAct", r"\mecunit MechUnit,num Axis,num Softness\num Ramp"),
    call("SoftDeact", r"\num Ramp"),
    call("SpeedLimAxis", "mecunit MechUnit,num AxisNumber,num AxisSpeed"),
    call("SpeedLimCheckPoint", "num RobSpeed"),
    call("SpeedRefresh", "num Override"),
    goes("SpotJ", MoveJ, STOPS, concat!(to!(), ",spotdata Spot", meets!())),
    goes("SpotL", MoveL, STOPS, concat!(to!(), ",spotdata Spot", meets!())),
    goes("SpotMJ", MoveJ, STOPS, concat!(to!(), ",...", meets!())),
    goes("SpotML", MoveL, STOPS, concat!(to!(), ",...", meets!())),
    call("SpyStart", "string File"),
    function("Sqrt", "num Value"),
    does("SSearchL", "...", Moves),
    call("StartLoad", r"\switch Dynamic,string FilePath\string File,INOUT loadsession LoadNo"),
    call("StartMove", r"\switch AllMotionTasks"),
    does("StepBwdPath", "num StepLength,num StepTime", Moves),
    call("SToolRotCalib", "robtarget RefTip,robtarget ZPos,robtarget XPos,INOUT tooldata Tool"),
    call("SToolTCPCalib", "robtarget Pos1,robtarget Pos2,robtarget Pos3,robtarget Pos4,INOUT tooldata Tool,INOUT num MaxErr,INOUT num MeanErr"),
    does("Stop", r"\switch NoRegain|switch AllMoveTasks", Stops),
    call("StopMove", r"\switch Quick\switch AllMotionTasks"),
    call("StopMoveReset", r"\switch AllMotionTasks"),
    call("StorePath", r"\switch KeepSync"),
    function("StrDigCalc", "stringdig StrDig1,opcalc Operation,stringdig StrDig2"),
    function("StrDigCmp", "stringdig StrDig1,opnum Relation,stringdig StrDig2"),
    function("StrFind", r"string Str,num ChPos,string Set\switch NotInSet"),
    function("StrFormat", r"string Format\..."),
    does("STriggJ", "...", Moves),
    does("STriggL", "...", Moves),
    function("StrLen", "string Str"),
    function("StrMap", "string Str,string FromMap,string ToMap"),
    function("StrMatch", "string Str,num ChPos,string Pattern"),
    function("StrMemb", "string Str,num ChPos,string Set"),
    function("StrOrder", "string Str1,string Str2,string Order"),
    function("StrPart", "string Str,num ChPos,num Len"),
    function("StrToByte", r"string ConStr\switch Hex|switch Okt|switch Bin|switch Char"),
    function("StrToVal", "string Str,INOUT anytype Val"),
    goes("StudL", MoveL, STOPS, concat!(to!(), ",...", meets!())),
    call("SyncMoveOff", r"syncident SyncID\num TimeOut"),
    call("SyncMoveOn", r"syncident SyncID,tasks TaskList\num TimeOut"),
    does("SystemStopAction", r"\switch Stop|switch StopBlock|switch Halt", Stops),
    function("Tan", "num Angle"),
    function("TasksInSync", "tasks TaskList"),
    function("TestAndSet", "INOUT bool Object"),
    function("TestDI", "signaldi Signal"),
    call("TestSignDefine", "num Channel,testsignal SignalId,mecunit MechUnit,num Axis,num SampleTime"),
    function("TestSignRead", "num Channel"),
    function("TextGet", "num Table,num Index"),
    function("TextTabFreeToUse", "string TableName"),
    function("TextTabGet", "string TableName"),
    call("TextTabInstall", "string File"),
    call("TPErase", ""),
    does("TPReadDnum", r"INOUT dnum TPAnswer,string TPText\...", Waits),
    does("TPReadFK", r"INOUT num TPAnswer,string TPText,string TPFK1,string TPFK2,string TPFK3,string TPFK4,string TPFK5\...", Waits),
    does("TPReadNum", r"INOUT num TPAnswer,string TPText\...", Waits),
    call("TPShow", "tpnum Window"),
    call("TPWrite", r"string String\num Num|bool Bool|pos Pos|orient Orient|dnum Dnum"),
    goes("TriggAbsJ", MoveAbsJ, ALONG, concat!(r"\switch Conc,", joints!(), ",triggdata Trigg_1", at!())),
    goes("TriggC", MoveC, ALONG, concat!(r"\switch Conc,", via!(), ",triggdata Trigg_1", at!())),
    call("TriggCheckIO", r"INOUT triggdata TriggData,num Distance\switch Start|switch Time,signal Signal,opnum Relation,num CheckValue\switch StopMove,intnum Interrupt\..."),
    call("TriggDataCopy", "triggdata Source,INOUT triggdata Destination"),
    call("TriggDataReset", "INOUT triggdata TriggData"),
    function("TriggDataValid", "triggdata TriggData"),
    call("TriggEquip", r"INOUT triggdata TriggData,num Distance\switch Start\switch Next,num EquipLag\signaldo DOp|signalgo GOp|signalao AOp|num ProcID,num SetValue\..."),
    call("TriggInt", r"INOUT triggdata TriggData,num Distance\switch Start|switch Time,intnum Interrupt\..."),
    call("TriggIO", r"INOUT triggdata TriggData,num Distance\switch Start|switch Time\signaldo DOp|signalgo GOp|signalao AOp|num ProcID,num SetValue\..."),
    goes("TriggJ", MoveJ, ALONG, concat!(r"\switch Conc,", to!(), ",triggdata Trigg_1", at!())),
    goes("TriggJIOs", MoveJ, PLAIN, concat!(to!(), at!())),
    goes("TriggL", MoveL, ALONG, concat!(r"\switch Conc,", to!(), ",triggdata Trigg_1", at!())),
    goes("TriggLIOs", MoveL, PLAIN, concat!(to!(), at!())),
    call("TriggRampAO", r"INOUT triggdata TriggData,num Distance\switch Start,num EquipLag,signalao AOutput,num SetValue,num RampLength\..."),
    call("TriggSpeed", r"INOUT triggdata TriggData,num Distance\switch Start,num ScaleLag,signalao AOutput,num ScaleValue\..."),
    function("Trunc", r"num Val\num Dec"),
    call("TryInt", "num DataObj"),
    does("TRYNEXT", "...", Leaves),
    call("TuneServo", r"mecunit MecUnit,num Axis,num TuneValue\tunetype Type"),
    function("Type", "anytype Data"),
    function("UIAlphaEntry", r"\..."),
    function("UIDnumEntry", r"\..."),
    function("UIMessageBox", r"\..."),
    does("UIMsgBox", r"\string Header,string MsgLine1\string MsgLine2\string MsgLine3\string MsgLine4\string MsgLine5\...", Waits),
    function("UINumEntry", r"\..."),
    call("UnLoad", r"\switch ErrIfChanged|switch Save,string FilePath\string File"),
    call("UnpackRawBytes", r"rawbytes RawData\switch Network,num StartIndex,INOUT anytype Value\switch Hex1|inttypes IntX|switch Float4|num ASCII"),
    function("ValidIO", "signal Signal"),
    function("ValToStr", "anytype Val"),
    function("VectMagn", "pos Vector"),
    call("VelSet", "num Override,num Max"),
    does("WaitAI", r"signalai Signal\switch LT|switch GT,num Value\...", Waits),
    does("WaitAO", r"signalao Signal\switch LT|switch GT,num Value\...", Waits),
    does("WaitDI", r"signaldi Signal,dionum Value\...", Waits),
    does("WaitDO", r"signaldo Signal,dionum Value\...", Waits),
    does("WaitGI", r"signalgi Signal\switch NOTEQ|switch LT|switch GT,num Value\...", Waits),
    does("WaitGO", r"signalgo Signal\switch NOTEQ|switch LT|switch GT,num Value\...", Waits),
    call("WaitLoad", r"\string UnloadPath\string UnloadFile,INOUT loadsession LoadNo\switch CheckRef"),
    does("WaitRob", r"\switch InPos|switch ZeroSpeed", Waits),
    call("WaitSensor", r"mecunit MechUnit\..."),
    does("WaitSyncTask", r"\switch InPos,syncident SyncID,tasks TaskList\...", Waits),
    does("WaitTestAndSet", "INOUT bool Object", Waits),
    does("WaitTime", r"\switch InPos,num Time", Waits),
    does("WaitUntil", r"\switch InPos,bool Cond\...", Waits),
    does("WaitWObj", r"wobjdata WObj\...", Waits),
    call("WorldAccLim", r"\num On|switch Off"),
    call("Write", r"iodev IODevice,string String\num Num|bool Bool|pos Pos|orient Orient|dnum Dnum\switch NoNewLine"),
    call("WriteAnyBin", "iodev IODevice,anytype Data"),
    call("WriteBin", "iodev IODevice,num Buffer,num NChar"),
    call("WriteCfgData", r"string InstancePath,string Attribute,anytype CfgData\num ListNo"),
    call("WriteRawBytes", r"iodev IODevice,rawbytes RawData\num NoOfBytes"),
    call("WriteStrBin", "iodev IODevice,string Str"),
    call("WZBoxDef", r"\switch Inside|switch Outside,INOUT shapedata Shape,pos LowPoint,pos HighPoint"),
    call("WZCylDef", r"\switch Inside|switch Outside,INOUT shapedata Shape,pos CenterPoint,num Radius,num Height"),
    call("WZDisable", "wztemporary WorldZone"),
    call("WZDOSet", r"\switch Temp|switch Stat,INOUT wztemporary WorldZone\switch Inside|switch Before,shapedata Shape,signaldo Signal,dionum SetValue"),
    call("WZEnable", "wztemporary WorldZone"),
    call("WZFree", "wztemporary WorldZone"),
    call("WZHomeJointDef", r"\switch Inside|switch Outside,INOUT shapedata Shape,jointtarget MiddleJointVal,jointtarget DeltaJointVal"),
    call("WZLimJointDef", r"\switch Inside|switch Outside,INOUT shapedata Shape,jointtarget LowJointVal,jointtarget HighJointVal"),
    call("WZLimSup", r"\switch Temp|switch Stat,INOUT wztemporary WorldZone,shapedata Shape"),
    call("WZSphDef", r"\switch Inside|switch Outside,INOUT shapedata Shape,pos CenterPoint,num Radius"),
];

/// Names with the same arguments, and whether they are functions.
type Group = (&'static str, &'static str, bool);

/// Without arguments; then others, most of add-ins and options, whose arguments are not known.
static GROUPS: [Group; 19] = [
    (BARE, "", false),
    (BARE_FUNCTIONS, "", true),
    (OTHERS, "...", false),
    (OTHER_FUNCTIONS, "...", true),
    // RobotWare; of `FitSphere` there is only a program that calls it.
    (
        "CornerPathWarning FitCircle FitSphere IoCtrlAxis_RefSync IoCtrlAxis_RefSyncOff \
            IoCtrlAxis_RefSyncOn SoftElbow",
        "...",
        false,
    ),
    // `LINKEDM.sys`, which is in backups of IRC5, and `HandDriver.sys` of a YuMi.
    ("Linked_m Linked_m_exe EventLog", "...", false),
    // Conveyor Tracking.
    ("CnvPredictReach GetMaxUsageTime ResetMaxUsageTime UseReachableTargets", "...", false),
    // PickMaster: 3HAC064218, and ABB's `PMppa340.prg` in public repositories.
    ("AckItmTgt FlushItmSrc GetItmTgt NewItmSrc NextItmTgtType QStartItmSrc", "...", false),
    ("QStopItmSrc ResetFlowCount", "...", false),
    // Palletizing: ABB's `PmMain.mod` and `PmProjServer.mod`, and a list of its PowerPac.
    (
        "PmAckTarget PmCalcArmConf PmCalcIntermid PmErrorLog PmGetFlow PmGetFlowInfo \
            PmGetOperation PmGetProjectInfo PmGetWaInfo PmSetRecoverAction PmStartFlow \
            PmStartProj PmStopFlow PmStopProj PmWaitProjStart",
        "...",
        false,
    ),
    ("PmGetTarget PmGetTgtAction PmSetDefaultHeight", "...", true),
    // Paint.
    ("ConsoleWrite IpsSetParam PntProdUserLog UseBrushTab", "...", false),
    (
        "IndexLookup IpsCommand IpsGetParam PaintCommand PntQueueExtraGet PntQueueExtraSet \
            PntQueuePeek",
        "...",
        true,
    ),
    // Tool changers.
    ("TcCloseCover TcDropOffTool TcLockTool TcOpenCover TcPickupTool TcUnlockTool", "...", false),
    // Dispensing.
    ("SyncWWObj", "...", false),
    ("GetSignalDnum", "...", true),
    // Continuous Application Platform.
    ("CapAPTrSetupAI CapAPTrSetupAO CapAPTrSetupPERS CAPSetStopMode", "...", false),
    // Homepos-Running.
    (
        "HR_Exit HR_ExitCycle HR_SavePos HR_SetMoveToStartPos HR_SetTypeDIndex HR_SetTypeIndex",
        "...",
        false,
    ),
    ("HR_GetTypeDIndex HR_GetTypeIndex HR_RobotInHome", "...", true),
];
const BARE: &str = "ActEventBuffer CheckProgRef ClearPath CorrClear DeactEventBuffer DitherDeact \
    HollowWristReset IDisable IEnable PathLengthReset PathLengthStart PathLengthStop \
    ResetPPMoved ResetRetryCount RestoPath RMQEmptyQueue SafetyControllerSyncRequest SkipWarn \
    SpyStop StartMoveRetry SyncMoveResume SyncMoveSuspend SyncMoveUndo TestSignReset \
    TuneReset UIMsgWriteAbort WarmStart";
const BARE_FUNCTIONS: &str = "CDate CorrRead CTime EventType ExecHandler ExecLevel GetMaxNumberOfCyclicBool \
    GetModalPayLoadMode GetUASUserName IsSyncMoveOn MaxRobSpeed MotionPlannerNo OpMode \
    PathLengthGet PathLevel PPMovedInManMode ProgMemFree Rand RemainingRetries RobName RobOS \
    SafetyControllerGetChecksum SafetyControllerGetOpModePinCode SafetyControllerGetSWVersion \
    SafetyControllerGetUserChecksum TaskRunMec TaskRunRob UIClientExist";
const OTHERS: &str = "ActivateProfile AliasCamera ArcClrPath ArcKill ArcRefresh BECheckTcp BEDebugState \
    BERefPointer BESetupToolJ BETcpExtend BEUpdateTcp BrakeCheck Calibrate CapAPTrSetup \
    CapCondSetDO CapEquiDist CapLATrSetup CapNoProcess CapRefresh CapWeaveSync CloseHighLift \
    CnvGenInstr CnvSync CSSAct CSSDeact CSSForceOffsetAct CSSForceOffsetDeact CSSOffsetTune \
    CyclicBrakeCheck DaActProc DaDeactAllProc DaDeactProc DaDefExtSig DaDefProcData \
    DaDefProcSig DaDefUserData DaGetAppDescr DaGetAppIndex DaGetCurrData DaGetNumOfProcs \
    DaGetNumOfRob DaGetPrcDescr DaSetCurrData DaSetupAppBehav DaStartManAction DeactProfile \
    EGMActJoint EGMActMove EGMActPose EGMGetId EGMReset EGMSetupAI EGMSetupAO EGMSetupGI \
    EGMSetupLTAPP EGMSetupUC EGMStop EGMStreamStart EGMStreamStop EGMWaitCond ExecEngine FCAct FCCalib \
    FCCondForce FCCondOrient FCCondPos FCCondReoriSpeed FCCondTCPSpeed FCCondTorque \
    FCCondWaitWhile FCDeact FCRefCircle FCRefForce FCRefLine FCRefMoveFrame FCRefRot \
    FCRefSpiral FCRefSprForceCart FCRefStart FCRefStop FCRefTorque FCResetDampingTune \
    FCResetLPFilterTune FCSetDampingTune FCSetLPFilterTune FCSpdChgAct FCSpdChgDeact \
    FCSpdChgTunReset FCSpdChgTunSet FCSupvForce FCSupvOrient FCSupvPos FCSupvReoriSpeed \
    FCSupvTCPSpeed FCSupvTorque FricIdEvaluate FricIdInit FricIdSetFricLevels g_BlowOff1 \
    g_BlowOff2 g_BlowOn1 g_BlowOn2 g_Calibrate g_GripIn g_GripOut g_Init g_JogIn g_JogOut \
    g_MoveTo g_SetForce g_SetMaxSpd g_Stop g_VacuumOff1 g_VacuumOff2 g_VacuumOn1 g_VacuumOn2 \
    GetGroupSignalInfo GetTorqueMargin Hand_DoCalibrate Hand_GripInward Hand_GripOutward \
    Hand_Initialize Hand_JogInward Hand_JogOutward Hand_MoveTo Hand_SetHoldForce \
    Hand_SetMaxSpeed Hand_Stop Hand_TurnOffBlow1 Hand_TurnOffBlow2 Hand_TurnOffVacuum1 \
    Hand_TurnOffVacuum2 Hand_TurnOnBlow1 Hand_TurnOnBlow2 Hand_TurnOnVacuum1 Hand_TurnOnVacuum2 \
    ICap IndCnvAddObject IndCnvDisable IndCnvEnable IndCnvInit IndCnvReset IndGunMove \
    IndGunMoveReset InitSuperv IPathPos IVarValue LoadId LoadProfile ManLoadIdProc MatrixReset \
    MatrixSolve MatrixSolveQR MatrixSVD MPLoadPath MPOffsEaxOnPath MPReadInPath MPSavePath \
    OpenHighLift PMgrGetNextPart PMgrRunMenu PMgrSetNextPart PrxActivAndStoreRecord \
    PrxActivRecord PrxDbgStoreRecord PrxDeactRecord PrxResetPos PrxResetRecords PrxSetPosOffset \
    PrxSetRecordSampleTime PrxSetSyncalarm PrxStartRecord PrxStopRecord PrxStoreRecord \
    PrxUseFileRecord ReadBlock ReadVarArr ReCalcTCP RecordProfile RecoveryMenu RecoveryMenuWR \
    RecoveryPosReset RecoveryPosSet RemoveCyclicBool RemoveSuperv ResetAxisDistance \
    ResetAxisMoveTime ResetTorqueMargin RMQSendWait SCWrite SetBrush SetBrushFac SetForce \
    SetTmSignal SetupCyclicBool SetupSuperv SetWRProcName SiClose SiConnect SiGetCyclic \
    SiSetCyclic STCalib STClose STIndGun STIndGunReset STOpen StoreProfile STTune STTuneReset \
    SupSyncSensorOff SupSyncSensorOn SwGetCalibData SwGetFixTipData SwSetIntForceData \
    SwSetIntGunData SwSetIntSimData SwSetIntSpotData SyncToSensor TriggStopProc UIMsgWrite \
    UIShow UseACCProfile WaitAndRecProf WriteBlock WriteVar WriteVarArr";
const OTHER_FUNCTIONS: &str = "CalcRotAxFrameZ CalcRotAxisFrame CapGetFailSigs DaCheckMMSOpt DaGetFstTimeEvt DaGetMP \
    DaGetRobotName DaGetTaskName DefAccFrame FCGetForce FCGetProcessData FCIsForceMode FCLoadID \
    g_GetPos g_GetPressure1 g_GetPressure2 g_IsCalibrated g_IsInPos GetAxisDistance \
    GetAxisMoveTime GetNextCyclicBool GetNextMechUnit GetServiceInfo GetSignal GetTSPStatus \
    Hand_GetActualPos Hand_GetStatus Hand_GetVacuumPressure1 Hand_GetVacuumPressure2 \
    Hand_IsCalibrated MaxExtLinearSpeed MaxExtReorientSpeed MaxRobReorientSpeed OFrameChange \
    OffsToolPolar OffsToolXYZ ParIdPosValid ParIdRobValid PMgrAtSafe PMgrAtService PMgrAtState \
    PMgrAtStation PMgrNextStation PMgrTaskName PMgrTaskNumber PoseAdd PrxGetMaxRecordpos ReadVar \
    STCalcForce STCalcTorque STIsCalib STIsClosed STIsIndGun STIsOpen SwGetCurrSpotName \
    SwGetCurrTargetName TaskIsActive TaskIsExecuting UIDnumTune UIListView UINumTune";

impl Entry {
    fn of(name: &str) -> Option<&'static Self> {
        let lower = |byte: u8| byte.to_ascii_lowercase();
        let order = |it: &Self| it.name.bytes().map(lower).cmp(name.bytes().map(lower));
        TABLE.binary_search_by(order).ok().map(|at| &TABLE[at])
    }

    /// The instruction of a name, in any case. Arc welding has a second and a third robot's, such as
    /// `ArcL1Start`.
    pub(crate) fn instruction(name: &str) -> Option<&'static Self> {
        let own = Self::of(name).filter(|it| !it.is_function);
        let is_numbered = || {
            let arc = name
                .get(..4)
                .filter(|it| ["ArcL", "ArcC"].iter().any(|of| of.eq_ignore_ascii_case(it)));
            arc.filter(|_| matches!(name.as_bytes().get(4), Some(b'1' | b'2')))
        };
        own.or_else(|| Self::of(&format!("{}{}", is_numbered()?, &name[5..])))
    }

    /// The function of a name, in any case; one of a dnum has the arguments of a num's.
    pub(crate) fn function(name: &str) -> Option<&'static Self> {
        let of_dnum = || {
            let (of_num, end) = name.split_at_checked(name.len().checked_sub("Dnum".len())?)?;
            Self::of(of_num).filter(|_| end.eq_ignore_ascii_case("Dnum"))
        };
        Self::of(name).or_else(of_dnum).filter(|it| it.is_function)
    }

    /// The arguments of an instruction or a function that is not in the table by itself.
    pub(crate) fn grouped(name: &str, is_function: bool) -> Option<&'static str> {
        let is_of = |(names, _, of): &&Group| {
            *of == is_function
                && names
                    .split(' ')
                    .any(|it| it.len() == name.len() && it.eq_ignore_ascii_case(name))
        };
        GROUPS.iter().find(is_of).map(|(_, arguments, _)| *arguments)
    }

    /// The names, the arguments, and whether it is a function, of all.
    #[doc(hidden)]
    pub fn all() -> impl Iterator<Item = (&'static str, &'static str, bool)> {
        let known = TABLE.iter().map(|it| (it.name, it.arguments, it.is_function));
        known.chain(GROUPS.iter().flat_map(|(names, arguments, is_function)| {
            names.split(' ').map(move |name| (name, *arguments, *is_function))
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_sorted_and_each_once() {
        let lower: std::vec::Vec<_> = TABLE.iter().map(|it| it.name.to_lowercase()).collect();
        assert!(lower.windows(2).all(|pair| pair[0] < pair[1]));
        let mut all: std::vec::Vec<_> = Entry::all().map(|it| it.0.to_lowercase()).collect();
        all.sort_unstable();
        assert!(all.windows(2).all(|pair| pair[0] != pair[1]));
    }
}
