"""Backups of controllers, written for tests."""

import zipfile

BACKINFO = """>>SYSTEM_ID:
Cell

>>PRODUCTS_ID:
{products}

>>HOME:

>>SYSPAR:
MOC.cfg

{tasks}
>>EOF:
"""
IDENTITY = (1, 0, 0, 0)


def cfg(domain, version, **types):
    """A configuration file: instances of each type, as texts of keys and values."""
    text = f"{domain}:CFG_1.0:{version}::\n"
    for name, instances in types.items():
        text += f"\n#\n{name}:\n" + "".join(f"\n      {it}\n" for it in instances)
    return text


def robot(name, type_name, prefix, base=(0, 0, 0), wxyz=IDENTITY, more=""):
    """A ROBOT: its base in meters; keys with their default are left out, as controllers do."""
    joints = " ".join(f'-use_joint_{i} "{prefix}_{i + 1}"' for i in range(6))
    keys = [
        f"-base_frame_pos_{axis} {value:.9g}"
        for axis, value in zip("xyz", base, strict=True)
        if value
    ]
    keys += [
        f"-base_frame_orient_u{i} {value:.9g}" for i, value in enumerate(wxyz) if value != (i == 0)
    ]
    lines = [f'-name "{name}" -use_robot_type "{type_name}"', joints, " ".join([*keys, more])]
    return "\\\n      ".join(filter(str.strip, lines))


def arms(prefix, limits_deg):
    """The ARM of each axis."""
    radians = [[f"{bound * 0.017453292519943295:.6g}" for bound in pair] for pair in limits_deg]
    return [
        f'-name "{prefix}_{axis}" -upper_joint_bound {upper} -lower_joint_bound {lower}'
        for axis, (lower, upper) in enumerate(radians, 1)
    ]


def backinfo(*tasks, products="RobotWare Version: 6.08.01.00"):
    """A backinfo.txt: name of each task and its modules."""
    sections = []
    for number, (name, *modules) in enumerate(tasks, 1):
        lines = "".join(f"{module}\n" for module in modules)
        sections.append(f">>TASK{number}: ({name},,)\n{lines}\n")
    return BACKINFO.format(products=products, tasks="".join(sections))


def written(folder, files):
    """Write the files of a backup, by path; texts or bytes."""
    for name, content in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return folder


def zipped(path, files):
    """Write files into an archive."""
    with zipfile.ZipFile(path, "w") as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return path


LIMITS = [(-180, 180), (-90, 150), (-180, 75), (-400, 400), (-125, 120), (-400, 400)]
MOC = cfg(
    "MOC", "6:0", ARM=arms("rob1", LIMITS), ROBOT=[robot("ROB_1", "ROB1_4600_2.55_40", "rob1")]
)
SYS = cfg("SYS", "6:0", CAB_TASKS=['-Name "T_ROB1" -Type "NORMAL" -MotionTask'])
MODULE = "MODULE Main\nENDMODULE\n"
SMALL = {
    "BACKINFO/backinfo.txt": backinfo(("T_ROB1", "PROGMOD/Main.mod @ ")),
    "SYSPAR/MOC.cfg": MOC,
    "SYSPAR/SYS.cfg": SYS,
    "RAPID/TASK1/PROGMOD/Main.mod": MODULE,
}
"""A sound backup of one robot."""
