"""RobotStudio's files of an arm of our own, in each spelling: XML and archives."""

import io
import zipfile

import numpy as np

HALF = np.pi / 2
# Twist, Length, Rotation, Offset: modified Denavit-Hartenberg rows.
ROWS = [
    (0.0, 0.0, 0.0, 0.0),
    (-HALF, 0.12, -HALF, 0.0),
    (0.0, 0.53, 0.0, 0.0),
    (-HALF, 0.07, 0.0, 0.61),
    (HALF, 0.0, -np.pi, 0.0),
    (HALF, 0.0, 0.0, 0.0),
]
LIMITS = np.radians([[-170, 170], [-80, 130], [-190, 70], [-200, 200], [-120, 120], [-350, 350]])
# -210 <= q2 + q3 <= 140 deg.
COUPLED = [([0.0, 1.0, 1.0, 0.0, 0.0, 0.0], 140.0), ([0.0, -1.0, -1.0, 0.0, 0.0, 0.0], 210.0)]
Q = np.radians([10, 20, 30, 40, 50, 60])
POSE = np.array([0.0, 0.0, 0.0, 0.0, 0.523599, 0.0])
BASE = np.eye(4)
BASE[2, 3] = 0.41
OFFSET = np.eye(4)
OFFSET[2, 3] = 0.09


def step(twist, length, rotation, offset):
    turn = [[np.cos(rotation), -np.sin(rotation), 0], [np.sin(rotation), np.cos(rotation), 0]]
    about_z = np.eye(4)
    about_z[:2, :3] = turn
    about_z[2, 3] = offset
    about_x = np.eye(4)
    about_x[1:3, 1:3] = [[np.cos(twist), -np.sin(twist)], [np.sin(twist), np.cos(twist)]]
    about_x[0, 3] = length
    return about_x @ about_z


def poses(q, rows=ROWS):
    """Poses of the links behind the joints, by the definition alone."""
    pose, found = BASE, []
    for (twist, length, rotation, offset), angle in zip(rows, q, strict=True):
        pose = pose @ step(twist, length, rotation + angle, offset)
        found.append(pose)
    return found


FLANGE = poses(np.zeros(6))[-1] @ OFFSET


def matrix_of(limits=LIMITS, coupled=()):
    """A and b of A q <= b."""
    n = len(limits)
    rows = [sign * np.eye(n)[joint] for joint in range(n) for sign in (1, -1)]
    bounds = [value for lower, upper in limits for value in (upper, -lower)]
    return (
        np.array([*rows, *(row for row, _ in coupled)]),
        np.array([*bounds, *(np.radians(bound) for _, bound in coupled)]),
    )


# An element is (name, {name: value}, [elements or a text]); a value is of an attribute, or a child.
def spelled(element, spelling):
    name, values, inside = element
    if spelling == "attributes":
        attributes = "".join(f' {key}="{value}"' for key, value in values.items())
        head = ""
    else:
        attributes = f' ID="{values["ID"]}"' if "ID" in values else ""
        rest = {key: value for key, value in values.items() if key != "ID"}
        head = "".join(f'<{key} Value="{value}" />' for key, value in rest.items())
    body = "".join(it if isinstance(it, str) else spelled(it, spelling) for it in inside)
    return f"<{name}{attributes}>{head}{body}</{name}>"


def doubles(values):
    return [f'<Double Value="{float(value)!r}" />' for value in np.ravel(values)]


def transform(name, pose):
    rows = [
        (f"Row{axis}", dict(zip("XYZW", map(float, column), strict=True)), [])
        for axis, column in zip("XYZT", np.transpose(pose), strict=True)
    ]
    return (name, {}, rows)


def matrix(name, values):
    values = np.asarray(values)
    size = {"NumCols": values.shape[1] if values.ndim > 1 else 1, "NumRows": len(values)}
    return (name, size, [("MatrixElements", {}, doubles(values.T))])


def joint_infos(rows, kinds, following=None):
    following = following or [*range(1, len(rows)), -1]
    return [
        (
            "Element",
            {"IsRevoluteJoint": str(kind).lower()},
            [
                (
                    "DHParameters",
                    {},
                    [
                        (
                            "Element",
                            {"NextJoint": following[i], "Link": i + 1}
                            | dict(
                                zip(("Twist", "Length", "Rotation", "Offset"), row, strict=True)
                            ),
                            [],
                        )
                    ],
                )
            ],
        )
        for i, (row, kind) in enumerate(zip(rows, kinds, strict=True))
    ]


def definition(
    key=20,
    rows=ROWS,
    kinds=None,
    limits=None,
    dependency=None,
    flange=FLANGE,
    following=None,
    model="SYN6_5_120",
    active=None,
    base=BASE,
    custom="false",
):
    """A MechanismDef and its ForwardKinematicsDH."""
    a, b = matrix_of() if limits is None else limits
    n = len(rows)
    active = n if active is None else active
    held = [("Name", {}, []), transform("OffsetTransform", flange)] if flange is not None else []
    flanges = [("Element", {"LinkIndex": n}, held)] if flange is not None else []
    return [
        (
            "MechanismDef",
            {"ID": key, "ModelName": model, "UsingCustomFwdKin": custom},
            [
                f'<ForwardKinematics DocID="-1" ID="{key + 1}" />',
                ("Flanges", {}, flanges),
                transform("ModelBaseFrame", np.eye(4)),
                '<KinematicsCLSID Value="" />',
            ],
        ),
        (
            "ForwardKinematicsDH",
            {"ID": key + 1, "NumActiveKJoints": active, "NumJoints": n, "NumLinks": n + 1},
            [
                ("BaseJoints", {}, ['<Integer Value="0" />']),
                matrix("JointDependency", np.eye(n, active) if dependency is None else dependency),
                matrix("JointLimitsMatrix", a),
                matrix("JointLimitsVector", b),
                ("JointZeroPosition", {}, []),
                ("KinematicBaseFrames", {}, [transform("Element", base)]),
                (
                    "JointInfos",
                    {},
                    joint_infos(rows, kinds or [True] * n, following),
                ),
            ],
        ),
    ]


def instance(
    key=1,
    name="SYN6_5_120__01",
    document=-1,
    of=20,
    q=POSE,
    links=None,
    at=None,
    extra=(),
    limits=None,
):
    """A MechanismInstance and its links: frames at zero joints, and poses at q."""
    zero = [np.eye(4), *poses(np.zeros(len(q)))] if links is None else links
    now = [np.eye(4), *poses(q)] if at is None else at
    named = ["Base", *(f"Link{i}" for i in range(1, len(zero)))]
    both = [*zip(named, zero, now, strict=True), *((it, np.eye(4), np.eye(4)) for it in extra)]
    keys = range(key + 1, key + 1 + len(both))
    a, b = limits or (np.empty((0, 0)), np.empty(0))
    return [
        (
            "MechanismInstance",
            {"ID": key, "Name": name, "NumJoints": len(q)},
            [
                f'<Definition DocID="{document}" ID="{of}" />',
                ("ChildInstances", {}, [f'<ObjectRef DocID="-1" ID="{it}" />' for it in keys]),
                transform("Transform", np.diag([-1.0, -1.0, 1.0, 1.0])),
                ("JointValues", {}, doubles(q)),
                *(
                    [matrix("JointLimitsMatrix", a), matrix("JointLimitsVector", b)]
                    if limits
                    else []
                ),
            ],
        ),
        *(
            (
                "MechanismLinkInstance",
                {"ID": it, "Name": own},
                [
                    transform("Transform", pose @ np.linalg.inv(frame)),
                    transform("CorrectionTransform", np.linalg.inv(frame)),
                ],
            )
            for it, (own, frame, pose) in zip(keys, both, strict=True)
        ),
    ]


LIBRARY = '<DocRef ID="1" Location="%ABB%\\SYN6_5_120__01.rslib" />'
REFERENCE = f"<ReferencedDocuments>{LIBRARY}</ReferencedDocuments>"


def pim(*elements, spelling="values", more=""):
    body = "".join(spelled(it, spelling) for group in elements for it in group)
    return (
        '\ufeff<?xml version="1.0" encoding="utf-8"?><PIMDocument xmlns="urn:abb-robotics-pim" '
        f'SaveVersion="25.4"><Objects>{body}</Objects>{more}</PIMDocument>'
    ).encode()


def archive(members):
    """A ZIP of contents by their names."""
    held = io.BytesIO()
    with zipfile.ZipFile(held, "w", zipfile.ZIP_DEFLATED) as file:
        for name, content in members.items():
            file.writestr(name, content)
    return held.getvalue()
