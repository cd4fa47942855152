// irbkin for C: kinematics of robot arms. Made by cbindgen: do not edit.
//
// Lengths are in meters, angles in radians. A pose is a 4x4 homogeneous matrix by rows, 16 numbers.
// docs/guide/c.md has examples.
//
// Memory: what a caller passes is the caller's, and is not kept. An argument X with its length
// X_len, counted in elements, must have exactly the length that is written at the function. A
// pointer of another argument has as many elements as is written there. Pointers are aligned. NULL
// is refused unless it is written that an argument may be NULL. What is written overlaps nothing
// else. Where a call fails, its outputs are undetermined unless something else is written.
//
// Handles: a function writes a new one into `made`, NULL where it fails. irbkin_..._free() frees
// it, once, after its last use. A freed handle must not be used: what happens is undefined. A
// library that was built for debugging refuses it.
//
// Errors: a function that returns IrbkinCode reports each error: NULL, a wrong length, numbers that
// are not finite, what irbkin refuses, and errors inside irbkin (panics). Nothing aborts but a lack
// of memory or of stack. irbkin_last_error() has the message.
//
// Threads: handles do not change. Any threads may use one at the same time; to free it, one thread
// must be alone with it. Each thread has its own last error. Threads that helped a batch wait for
// the next one: do not unload the library after that.
//
// No allocation: irbkin_fk, irbkin_jacobian, irbkin_ik, irbkin_ik_nearest, irbkin_configuration and
// irbkin_ik_configured do not use the heap where they succeed.

#ifndef IRBKIN_H
#define IRBKIN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Most joints of a robot.
#define IRBKIN_MOST_JOINTS 7

// Most slots of an answer.
#define IRBKIN_MOST_SLOTS 16

// The slot holds a solution.
#define IRBKIN_STATUS_FOUND 1

// The solution is inside the joint limits.
#define IRBKIN_STATUS_WITHIN_LIMITS 2

// The solution is at the wrist singularity.
#define IRBKIN_STATUS_WRIST 4

// The arm is stretched or folded.
#define IRBKIN_STATUS_ELBOW 8

// The solution is at the shoulder singularity.
#define IRBKIN_STATUS_SHOULDER 16

// The slot is empty: its solution coincides with another slot's at a singularity.
#define IRBKIN_STATUS_MERGED 32

// The input of this row was invalid.
#define IRBKIN_STATUS_INVALID 64

// It is not certain that the slots hold every solution of the pose.
#define IRBKIN_STATUS_UNCERTIFIED 128

// The outcome of a call. irbkin_last_error() has the sentence.
typedef enum {
  // The call succeeded.
  IRBKIN_CODE_OK = 0,
  // An argument is NULL, misaligned, of another length, no UTF-8, or none of its values.
  IRBKIN_CODE_INVALID_ARGUMENT = 1,
  // A pose is not a rigid transform.
  IRBKIN_CODE_INVALID_POSE = 2,
  // Joint angles are not finite, or do not fit the arm.
  IRBKIN_CODE_INVALID_JOINTS = 3,
  // The arm cannot be built, or cannot do what was asked.
  IRBKIN_CODE_INVALID_MODEL = 4,
  // An option of a plan is invalid.
  IRBKIN_CODE_INVALID_PLAN = 5,
  // A box, a margin or a body is invalid, or the arm has no body.
  IRBKIN_CODE_INVALID_BODY = 6,
  // The catalog has no arm of that name.
  IRBKIN_CODE_UNKNOWN_ROBOT = 7,
  // No solution is inside the limits.
  IRBKIN_CODE_UNREACHABLE = 8,
  // No solution has that configuration.
  IRBKIN_CODE_NO_CONFIGURATION = 9,
  // The joints cannot follow the path without a break. What they can follow is written.
  IRBKIN_CODE_BROKEN_PATH = 10,
  // An error inside irbkin. Outputs are undetermined.
  IRBKIN_CODE_PANIC = 11,
} IrbkinCode;

// The frame in which a Jacobian is.
typedef enum {
  // That of the base, or of the world if the robot has a base in it.
  IRBKIN_FRAME_BASE = 0,
  // That of the tool.
  IRBKIN_FRAME_TOOL = 1,
} IrbkinFrame;

// Obstacles around an arm. They do not change: any threads may use them at the same time.
typedef struct IrbkinCell IrbkinCell;

// A robot arm. It does not change: any threads may use it at the same time.
typedef struct IrbkinRobot IrbkinRobot;

// Parameters of an ortho-parallel arm with a spherical wrist.
typedef struct {
  // Distance of axis 2 from axis 1 [m].
  double a1;
  // Distance of axis 4 from axis 3 [m].
  double a2;
  // Lateral offset of the wrist center [m].
  double b;
  // Height of axis 2 [m].
  double c1;
  // Distance of axis 3 from axis 2 [m].
  double c2;
  // Distance of the wrist center from axis 3 along axis 4 [m].
  double c3;
  // Distance of the flange from the wrist center [m].
  double c4;
  // Joint offsets [rad]; ABB: 0, 0, -pi/2, 0, 0, 0.
  double offsets[6];
  // Joint signs, each 1 or -1.
  int8_t signs[6];
} IrbkinOpwParameters;

// The freedoms of a plan and its conditions. All zeros: nothing is free, nothing is kept.
typedef struct {
  // Number of angles about its z axis that the tool may take; 0: the tool does not turn.
  size_t rotation_steps;
  // Lowest of these angles [rad].
  double rotation_lower;
  // Largest of these angles [rad]; both 0: a full turn.
  double rotation_upper;
  // Time of each pose [s]: no joint is faster than its limit. NULL: even pace.
  const double *times;
  // The dof joint angles at the first pose [rad], or NULL.
  const double *start;
  // The dof joint angles at the last pose [rad], or NULL.
  const double *end;
  // Not 0: the joints end where they start.
  int32_t closed;
  // Obstacles that the arm stays out of, between the poses too; or NULL.
  const IrbkinCell *cell;
} IrbkinPlanOptions;

// The figures of a plan.
typedef struct {
  // Weighted sum of the squares of all joint steps [rad^2].
  double cost;
  // Largest velocity of a joint as a part of its limit; without times, the least time [s] at an
  // even pace.
  double bottleneck;
  // Number of places where the joints cannot follow.
  size_t breaks;
  // 1 if every step was shown to be continuous between its two poses, else 0.
  int32_t certified;
} IrbkinPlanReport;

// An obstacle that is a box.
typedef struct {
  // Its name; no two boxes of a cell have the same.
  const char *name;
  // Lengths of its edges [m].
  double size[3];
  // The pose of its center in the world, a 4x4 matrix by rows.
  double pose[16];
} IrbkinBox;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// The version of the library, as "0.1.0".
const char *irbkin_version(void);

// The message of the last call of this thread that failed, which names the argument, its value and
// the bound; empty if none failed. It is valid until the next call of this thread that fails.
const char *irbkin_last_error(void);

// Make the arm of the catalog with a name, as "IRB 2600-12/1.65" or "UR5e".
//
// Case, blanks, "-", "_" and "/" do not matter. An error lists close names.
IrbkinCode irbkin_robot_named(const char *name, IrbkinRobot **made);

// Make the arm of six or seven revolute joints between two links of a URDF.
//
// `urdf` is its text, not a file name. `base` and `tip` are names of links; NULL where the text
// has only one choice.
IrbkinCode irbkin_robot_from_urdf(const char *urdf,
                                  const char *base,
                                  const char *tip,
                                  IrbkinRobot **made);

// Make an arm of a modified (Craig) Denavit-Hartenberg table without limits.
//
// `rows` has alpha [rad], a [m], d [m] and the theta offset [rad] of each joint: `rows_len` is 24
// or 28.
IrbkinCode irbkin_robot_from_mdh(const double *rows, size_t rows_len, IrbkinRobot **made);

// Make an arm of a standard Denavit-Hartenberg table without limits, as irbkin_robot_from_mdh().
IrbkinCode irbkin_robot_from_sdh(const double *rows, size_t rows_len, IrbkinRobot **made);

// Make an arm of the parameters of an ortho-parallel arm with a spherical wrist without limits.
IrbkinCode irbkin_robot_from_opw(const IrbkinOpwParameters *parameters, IrbkinRobot **made);

// Make a robot with its tool center point at `tool` in the flange frame, a 4x4 matrix by rows.
IrbkinCode irbkin_robot_with_tool(const IrbkinRobot *robot, const double *tool, IrbkinRobot **made);

// Make a robot with its base at `base` in the world, a 4x4 matrix by rows. Poses are then in the
// world.
IrbkinCode irbkin_robot_with_base(const IrbkinRobot *robot, const double *base, IrbkinRobot **made);

// Make a robot with other joint limits: lower and upper limit of each joint [rad], 2 dof numbers,
// infinite where a joint has none.
IrbkinCode irbkin_robot_with_limits(const IrbkinRobot *robot,
                                    const double *limits,
                                    size_t limits_len,
                                    IrbkinRobot **made);

// Make a robot with an approximate body, from the lengths of its table: the real arm may reach
// outside it. Arms of the catalog have a body; an arm of a table needs one for collisions.
IrbkinCode irbkin_robot_with_approximate_body(const IrbkinRobot *robot, IrbkinRobot **made);

// Free a robot; NULL does nothing. Robots that were made of it stay.
void irbkin_robot_free(IrbkinRobot *robot);

// Number of joints, 6 or 7; 0 if `robot` is NULL.
size_t irbkin_robot_dof(const IrbkinRobot *robot);

// Number of slots of an answer, at most IRBKIN_MOST_SLOTS; 0 if `robot` is NULL, and of seven
// joints of which the first six are not independent.
size_t irbkin_robot_slot_count(const IrbkinRobot *robot);

// The name, empty of an arm of a table; NULL if `robot` is NULL. It lives as long as the robot.
const char *irbkin_robot_name(const IrbkinRobot *robot);

// Write the lower and upper limit of each joint [rad], 2 dof numbers.
IrbkinCode irbkin_robot_limits(const IrbkinRobot *robot, double *limits, size_t limits_len);

// Write the pose of the tool at joint angles [rad]: 16 numbers, a 4x4 matrix by rows.
IrbkinCode irbkin_fk(const IrbkinRobot *robot, const double *q, size_t q_len, double *pose);

// Write the geometric Jacobian of the tool at joint angles [rad]: 6 rows of dof numbers, three
// linear [m/rad], then three angular [1].
//
// `frame` is an IrbkinFrame.
IrbkinCode irbkin_jacobian(const IrbkinRobot *robot,
                           const double *q,
                           size_t q_len,
                           int32_t frame,
                           double *jacobian,
                           size_t jacobian_len);

// Write every solution of a pose, each in its slot.
//
// `q` has slot_count rows of dof joint angles [rad], NaN in an empty slot; `status` has the flags
// IRBKIN_STATUS_... of each slot. `found` is the number of solutions, or NULL. A pose out of reach
// has none: irbkin_explain() says why.
//
// `q7` is the angle of joint 7 of seven joints [rad]; NULL of six.
IrbkinCode irbkin_ik(const IrbkinRobot *robot,
                     const double *pose,
                     const double *q7,
                     double *q,
                     size_t q_len,
                     uint8_t *status,
                     size_t status_len,
                     size_t *found);

// Write the outcome of irbkin_ik() in a sentence: how many solutions a pose has, or why it has
// none.
//
// `text` has `text_len` bytes, the final zero among them; a longer sentence is cut off.
IrbkinCode irbkin_explain(const IrbkinRobot *robot,
                          const double *pose,
                          const double *q7,
                          char *text,
                          size_t text_len);

// Write the solution inside the limits that is nearest to `seed` [rad] among all 2 pi equivalents,
// and of seven joints among all angles of joint 7.
//
// `seed`, `weights` and `q` have `len` numbers, dof; `weights` may be NULL: all are 1.
// IRBKIN_CODE_UNREACHABLE if no solution is inside.
IrbkinCode irbkin_ik_nearest(const IrbkinRobot *robot,
                             const double *pose,
                             const double *seed,
                             const double *weights,
                             double *q,
                             size_t len);

// Write ABB's confdata cf1, cf4, cf6, cfx of joint angles [rad].
IrbkinCode irbkin_configuration(const IrbkinRobot *robot,
                                const double *q,
                                size_t q_len,
                                int32_t *confdata);

// Write the solution with ABB's confdata cf1, cf4, cf6, cfx.
//
// `seed` may be NULL; of several solutions the nearest to it is written. `arm_angle` is the arm
// angle of a YuMi [rad], NULL of other arms. IRBKIN_CODE_NO_CONFIGURATION if no solution has the
// confdata: the message lists the existing ones.
IrbkinCode irbkin_ik_configured(const IrbkinRobot *robot,
                                const double *pose,
                                const int32_t *confdata,
                                const double *seed,
                                const double *arm_angle,
                                double *q,
                                size_t q_len);

// Write the poses of many joint vectors: `count` rows of dof angles [rad] to `count` rows of 16
// numbers, NaN for a row that is not finite.
//
// Up to `threads` threads help; 0 and 1: none.
IrbkinCode irbkin_fk_batch(const IrbkinRobot *robot,
                           const double *q,
                           size_t q_len,
                           double *poses,
                           size_t poses_len,
                           size_t threads);

// Write every solution of many poses, as irbkin_ik().
//
// `poses` has `count` rows of 16 numbers, `angles` the angle of joint 7 of seven joints at each;
// NULL of six. `q` has `count` times slot_count rows of dof angles [rad], `status` as many flags.
// A row that is no pose has NaN and IRBKIN_STATUS_INVALID; the others are solved.
//
// Up to `threads` threads help; 0 and 1: none.
IrbkinCode irbkin_ik_batch(const IrbkinRobot *robot,
                           const double *poses,
                           size_t count,
                           const double *angles,
                           double *q,
                           size_t q_len,
                           uint8_t *status,
                           size_t status_len,
                           size_t threads);

// Write whether an arm collides at many joint vectors: with itself, or with what is in a cell.
//
// `cell` may be NULL: the arm is alone. `q` has `count` rows of dof angles [rad], `collides` has
// `count` elements. Up to `threads` threads help; 0 and 1: none.
IrbkinCode irbkin_collides(const IrbkinRobot *robot,
                           const IrbkinCell *cell,
                           const double *q,
                           size_t count,
                           bool *collides,
                           size_t threads);

// Write one continuous joint path inside the limits along `count` poses, from the solution that is
// nearest to `seed` [rad].
//
// `seed` has dof angles, `q` has `count` rows of dof, NaN where a pose is not reached. `is_break`
// has `count` elements or is NULL: true where a pose is not reached, or by a jump only.
// IRBKIN_CODE_BROKEN_PATH if there is one: the message has the first and its reason.
IrbkinCode irbkin_follow(const IrbkinRobot *robot,
                         const double *poses,
                         size_t count,
                         const double *seed,
                         size_t seed_len,
                         double *q,
                         size_t q_len,
                         bool *is_break);

// Write the best joint path along `count` poses, over all branches, turns and what is free.
//
// `options` may be NULL. `q` has `count` rows of dof angles [rad]. `tool_angle` [rad] and `slot`
// have `count` elements, or are NULL, and so is `report`. IRBKIN_CODE_BROKEN_PATH if no path is
// without breaks: the message has the reason of each branch, and the path with the fewest breaks
// is written, NaN and slot -1 where it has none.
IrbkinCode irbkin_plan(const IrbkinRobot *robot,
                       const double *poses,
                       size_t count,
                       const IrbkinPlanOptions *options,
                       double *q,
                       size_t q_len,
                       double *tool_angle,
                       int32_t *slot,
                       IrbkinPlanReport *report);

// Make a cell of `count` boxes, from which an arm is to stay at least `margin` [m].
IrbkinCode irbkin_cell_of_boxes(const IrbkinBox *boxes,
                                size_t count,
                                double margin,
                                IrbkinCell **made);

// Free a cell; NULL does nothing.
void irbkin_cell_free(IrbkinCell *cell);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* IRBKIN_H */

