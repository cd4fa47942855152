//! Every threshold of the library that answers and flags depend on, with its unit and its reason.
//! `docs/evidence/accuracy.md` derives them. Parameters of one algorithm are beside it.

/// How far a rotation's columns may deviate from orthonormal and still be repaired: the largest
/// element of `R^T R - I` [1]. Elements in single precision (6e-8 off) and in text with six digits
/// (1e-6 off) are inside, a scaled or sheared matrix is not.
pub(crate) const ROTATION_REPAIR_BOUND: f64 = 1e-5;

/// Deviation below which a rotation is used unchanged [1]: a product of seven rotations in float64
/// deviates this much, and a repair gains nothing.
pub(crate) const ROTATION_ROUNDING: f64 = 4e-15;

/// How far the last row of a pose may deviate from 0 0 0 1 [1]: the error of a numerically inverted
/// matrix.
pub(crate) const LAST_ROW_BOUND: f64 = 1e-9;

/// How far a quaternion's norm may be from one [1]. Normalizing keeps the direction, so text with
/// three digits is accepted.
pub const QUATERNION_NORM_BOUND: f64 = 2e-3;

/// Greatest Euler angle [rad]: a full turn, as text with four decimals writes it. More are degrees.
pub(crate) const MOST_EULER: f64 = core::f64::consts::TAU + 1e-4;

/// Cosine of the middle ZYX angle below which the outer two act as one [1]: a few roundings of a
/// rotation's elements.
pub(crate) const GIMBAL_COS: f64 = 1e-14;

/// How far beyond reach the wrist center may be and still get the stretched (or folded) arm [m].
pub const REACH_TOLERANCE: f64 = 1e-9;

/// sin q5
///
/// below which the two branches of the wrist are one [1]. No encoder resolves a nanoradian; both
/// are returned from 2e-9 on.
pub const WRIST_MERGE_SIN: f64 = 1.5e-9;

/// sin q5
///
/// below which a pose does not determine q4 [1]: the rounding of the wrist's rotation, so a free
/// choice does not change the residual.
pub const WRIST_FREE_SIN: f64 = 5e-15;

/// Distance of the wrist center from axis 1 below which the front and the back branch are one [m];
/// both are returned from 2e-9 on. This holds without a lateral offset: with one, they meet by the
/// square root of [`POSITION_ROUNDING`].
pub const SHOULDER_MERGE: f64 = 1.5e-9;

/// How far rounding moves a position, relative to the lengths it is summed from [1]: twice the
/// worst of a million poses. A wrist center this close to axis 1 does not determine q1. An elbow
/// whose straightening moves the wrist center by half of this is straight, and its two branches are
/// one: below about 1e-7 rad from stretched, by the square root of rounding.
pub const POSITION_ROUNDING: f64 = 1.5e-15;

/// How far a pose may be turned about axis 1 for an arm of five axes to reach it, unless a caller
/// says otherwise [rad]: text with six digits is inside.
pub(crate) const HEADING_TOLERANCE: f64 = 1e-5;

/// Sine of the angle between axes 1 and 5 of an arm of five axes
///
/// below which a pose does not determine the plane of the arm [1]: three times
/// [`WRIST_FREE_SIN`], since base and tool rotate the pose.
pub(crate) const UPRIGHT_SIN: f64 = 1.5e-14;

/// How close to a singularity a seeded solve may keep the seed's value of the undetermined joint
/// [rad, m]: the precision of the best poses met in practice.
pub const SEEDED_FREE: f64 = 1e-12;

/// Least singular value of the closure of an arm without a closed form, lengths in units of the arm,
/// below which a joint vector is flagged as singular [1]: the root of rounding, at which two
/// solutions merge.
pub(crate) const CLOSURE_SINGULAR: f64 = 1e-7;

/// sin q5
///
/// below which a path may keep the q4 that it is heading for [1], within the uncertainty of the
/// forearm.
pub(crate) const PATH_WRIST_SIN: f64 = 1e-3;

/// Distance of the wrist center from axis 1, relative to the lengths of the arm, above which a path
/// leaves joint 1 to the pose [1]: its uncertainty is below [`SEEDED_FREE`].
pub(crate) const PATH_SHOULDER: f64 = POSITION_ROUNDING / SEEDED_FREE;

/// Distance of the wrist center from axis 1, relative to the lengths of the arm, above which a
/// branch is regular [1]: every decision is then far from its threshold, so that the branch can be
/// solved in lanes. Nearer, the scalar solver decides; both agree to rounding.
pub(crate) const REGULAR_SHOULDER: f64 = 1e-6;

/// Distance of the wrist center from the edge of reach, relative to the lengths of the arm, above
/// which a branch is regular [1].
pub(crate) const REGULAR_REACH: f64 = 1e-7;

/// Length of the forearm, relative to the upper arm, above which a branch is regular [1]: below,
/// its direction is a small difference.
pub(crate) const REGULAR_FOREARM: f64 = 0.25;

/// sin q5
///
/// above which a branch is regular [1].
pub(crate) const REGULAR_WRIST_SIN: f64 = 1e-6;

/// sin
///
/// of the elbow angle above which a branch of a seven-axis arm is regular [1]: below, the rounding
/// error of the elbow turns the upper arm.
pub(crate) const REGULAR_ELBOW_SIN: f64 = 1e-2;

/// Distance of the shoulder from the plane of axes 5 and 6, relative to the lengths of the arm,
/// above which a branch of a seven-axis arm is regular [1].
pub(crate) const REGULAR_ASIDE: f64 = 3e-3;

/// Spacing of the angles of joint 7 at which all solutions are computed [rad].
pub(crate) const JOINT_7_SPACING: f64 = 0.06;
/// The finer spacing that is used if the first finds none inside the limits [rad].
pub(crate) const JOINT_7_FINER_SPACING: f64 = 0.015;

/// Angle by which a joint may differ between two neighboring samples [rad]: valleys of the cost are
/// wider.
pub(crate) const SAMPLE_LEAP: f64 = 0.5;

/// Step below which a curve of self-motion ends, and a valley is at its bottom [rad]: its square is
/// the rounding of a cost.
pub(crate) const LEAST_CURVE_STEP: f64 = 1e-8;

/// How near a curve of self-motion is to crossing itself where its other branch is searched: the
/// least singular value of the Jacobian, relative to the greatest [1], and the distance from the
/// singularity of the six other joints [rad, m]. Farther away, the samples of joint 7 tell the
/// branches apart.
pub(crate) const NEAR_CROSSING: f64 = 0.05;

/// Largest difference of the two sides of an edge of joint 7, relative to their size, at which they
/// touch [1]: the rounding of a double zero, with a margin. An angle that is tried in vain costs
/// one solve.
pub(crate) const TOUCHING: f64 = 1e-12;

/// How far a solution may be from its pose and still be accepted as one of it [m, rad]: more than
/// the error of any self-motion or stretched arm, less than another pose.
pub(crate) const SOLUTION_OFF: f64 = 1e-6;

/// How far an angle may exceed a joint limit and still be inside [rad]: a pose taught at the limit
/// must not be lost to rounding.
pub const LIMIT_TOLERANCE: f64 = 1e-9;

/// How far given joint angles at an end of a motion may exceed a limit and be moved to it [rad]: a
/// controller reports them with six or seven digits.
pub const START_TOLERANCE: f64 = 1e-6;

/// How far outside its limits a joint may be computed that rounding leaves undetermined at a
/// singular pose, and still be moved inside them, if that reaches the pose [rad]: ten times the
/// uncertainty of a joint whose lever is [`SEEDED_FREE`].
pub(crate) const LIMIT_SLACK: f64 = 1e-2;

/// Least length of an upper arm or forearm [m].
pub(crate) const LEAST_LINK: f64 = 1e-6;

/// Least sine of the angles between axes 3 and 4 and between axes 4 and 5 of an offset wrist [1]:
/// where they are parallel, axis 5 does not depend on the elbow, or axes 4 and 5 are one.
pub(crate) const LEAST_TWIST_SIN: f64 = 1e-2;

/// Greatest length of a model [m]: squares and sums of it stay exact to rounding, and no arm is
/// longer.
pub const MOST_LENGTH: f64 = 1e6;

/// Farthest that the common normal of two axes of a corrected table may be [m]: half of
/// [`MOST_LENGTH`], since the offset of an axis is the sum of two. Rounding of such an offset moves
/// the tool by a nanometer; axes that are nearer to parallel count as parallel, which moves it by
/// at most a micrometer for each meter of reach.
pub(crate) const FARTHEST_NORMAL: f64 = MOST_LENGTH / 2.0;

/// Longest tool that is taken, in sizes of the arm [1], the largest distance of its flange from an
/// axis in two poses. No arm carries a longer one; for most a tool of 20 mm in millimeters is one.
pub const MOST_TOOL: f64 = 10.0;

/// Farthest that the flange of an arm may be from its base [m]: the longest manipulators reach 70
/// m, and an arm in millimeters hundreds.
#[doc(hidden)]
pub const MOST_REACH: f64 = 100.0;

/// Sizes of joint limits that are in degrees, where more than half of the joints have one [rad]:
/// from eight turns on, which an arm may have at its wrist but not everywhere. Above, a limit
/// stands for none.
pub(crate) const DEGREE_LIMITS: core::ops::RangeInclusive<f64> = 50.0..=1000.0;

/// How far outside its limits a joint of a joint vector may be, and how large most joints of a
/// motion may be [rad]: four turns. A seed may be two turns away; degrees are farther off.
#[doc(hidden)]
pub const FARTHEST_OUTSIDE: f64 = 4.0 * core::f64::consts::TAU;

/// Greatest angle of a model and greatest joint limit [rad], apart from no limit: beyond, full
/// turns lose the angle's digits.
pub const MOST_ANGLE: f64 = 1e5;

/// How far a Denavit-Hartenberg table may deviate from a known structure and still be recognized
/// [rad, m]: the rounding of a table in text. The deviation is removed.
pub const FORM_TOLERANCE: f64 = 1e-9;

/// How far the tool of a calibrated arm may be from its nominal one's [rad, or part of the
/// reach]: Newton's method starts from the nominal joints, and no maker's arm is so far off.
pub(crate) const FAR_FROM_NOMINAL: f64 = 0.05;

/// Greatest `snap` [rad]: how far an angle may be from a multiple of 90 deg and still be made exact
/// on request. Text with three digits is inside. Beyond, the arm would be a different one: a tenth
/// of a degree moves the tool of a long arm by millimeters.
pub(crate) const MOST_SNAP: f64 = 1e-3;

/// Growth of a joint step over the previous one from which it is examined as a jump [1].
pub(crate) const JUMP_GROWTH: f64 = 3.0;

/// Joint step that is never examined as a jump [rad]: two degrees.
pub(crate) const JUMP_LEAST: f64 = 0.035;

/// Joint step that is reported as a jump if the way between the two poses cannot be examined [rad]:
/// 20 degrees.
pub(crate) const JUMP_BLIND: f64 = 0.35;

/// Largest joint step between two points at which the way between two poses is examined [rad].
pub const EXAMINED_STEP: f64 = 0.1;

/// Joint step below which an arm with axis 4 locked has converged [rad]: rounding.
pub(crate) const LOCKED_CONVERGED: f64 = 1e-15;

/// Joint step up to which a path is extrapolated [rad].
pub(crate) const STEADY_STEP: f64 = 0.1;

/// sin q5
///
/// below which a singularity mode acts [1]: one degree. "wrist" may then deviate by two in
/// orientation.
pub const WRIST_ZONE: f64 = 0.0175;

/// Angle from a wrist or an elbow singularity within which tables name it [rad]: one degree, where
/// joints 4 and 6 turn 57 times as fast as the tool.
pub const NEAR_ANGLE: f64 = core::f64::consts::PI / 180.0;

/// Distance from the shoulder singularity within which tables name it [m]: there joint 1 turns at
/// 100 rad/s where the wrist passes axis 1 at 1 m/s.
pub const NEAR_LENGTH: f64 = 0.01;

/// How close to the edge of a quarter turn an angle matches either side of it in a configuration
/// [rad]: 0.01 deg, the rounding of a robtarget's printed digits.
pub const CONFIGURATION_EDGE: f64 = 0.01 * core::f64::consts::PI / 180.0;

/// How far beyond its limits a joint of a GoFa or YuMi may be in a taught target [rad]: arms that
/// are guided by hand pass their limits, by 1.1 deg in controllers' backups.
pub const TAUGHT_BEYOND_LIMITS: f64 = 1.5 * core::f64::consts::PI / 180.0;

/// Difference between an arm angle and the one that is asked for [rad] up to which they are the
/// same: robtargets hold it with nine digits of a degree, and a controller computes it to seven.
pub(crate) const ARM_ANGLE_OFF: f64 = 1e-6;

/// Square of a length below which a mirror does not turn it [(m/rad)^2, 1]: the least whose digits,
/// and of its summands, are all there. The length counts as zero, which moves a
/// singular value by no more than its root.
pub(crate) const REFLECTED_SQUARE: f64 = 1e-290;
