// Laws of the C interface: laws URDF. The answers are, to the last digit, as the Rust crate
// gave in the same run, and what is refused is refused in words.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "arm.h"
#include "expected.h"

#define COUNT(array) (sizeof(array) / sizeof *(array))
#define LAW(holds)                                                                                \
    do {                                                                                          \
        laws++;                                                                                   \
        if (!(holds)) {                                                                           \
            fprintf(stderr, "%s:%d: %s (%s)\n", __FILE__, __LINE__, #holds, irbkin_last_error()); \
            exit(1);                                                                              \
        }                                                                                         \
    } while (0)
#define SUCCEEDS(call) LAW((call) == IRBKIN_CODE_OK)
// A call fails with a code, and its message has some words.
#define REFUSED(call, code, words) \
    LAW((call) == IRBKIN_CODE_##code && strstr(irbkin_last_error(), words))

static int laws;

// Whether numbers are equal; any NaN is equal to any other. Zeros may have any sign: valgrind's
// differ.
static bool same(const double *a, const double *b, size_t count) {
    for (size_t i = 0; i < count; i++) {
        if (!(isnan(a[i]) && isnan(b[i])) && a[i] != b[i]) {
            fprintf(stderr, "[%zu] is %a, not %a\n", i, a[i], b[i]);
            return false;
        }
    }
    return true;
}

static char *content(const char *path) {
    FILE *file = fopen(path, "rb");
    char *text = calloc(1, 1 << 20);
    if (!file || !text || fread(text, 1, (1 << 20) - 1, file) == 0) {
        perror(path);
        exit(2);
    }
    fclose(file);
    return text;
}

// The robots of ARMS, made of names, a URDF and tables, and changed.
static void make_robots(const char *urdf, IrbkinRobot *robots[COUNT(ARMS)]) {
    IrbkinRobot *with_tool, *with_base;
    SUCCEEDS(irbkin_robot_named("IRB 2600-12/1.65", &robots[0]));
    SUCCEEDS(irbkin_robot_named("Panda", &robots[1]));
    SUCCEEDS(irbkin_robot_from_urdf(urdf, NULL, "tool0", &robots[2]));
    SUCCEEDS(irbkin_robot_from_mdh(MDH, COUNT(MDH), &robots[3]));
    SUCCEEDS(irbkin_robot_from_sdh(SDH, COUNT(SDH), &robots[4]));
    SUCCEEDS(irbkin_robot_from_opw(&OPW, &robots[5]));
    SUCCEEDS(irbkin_robot_with_tool(robots[0], TOOL, &with_tool));
    SUCCEEDS(irbkin_robot_with_base(with_tool, BASE, &with_base));
    SUCCEEDS(irbkin_robot_with_limits(with_base, LIMITS, COUNT(LIMITS), &robots[6]));
    irbkin_robot_free(with_tool);
    irbkin_robot_free(with_base);
    SUCCEEDS(irbkin_robot_named("irb 2600 12 1.65", &robots[7]));
}

// The arrays are on the heap and no longer than they are said to be: tools see what exceeds them.
static void an_arm_has_the_answers_of_the_rust_crate(const IrbkinRobot *robot, const Arm *arm) {
    size_t dof = irbkin_robot_dof(robot), slots = irbkin_robot_slot_count(robot), found;
    LAW(strcmp(irbkin_robot_name(robot), arm->name) == 0);
    LAW(dof == arm->dof && slots == arm->slot_count);
    double *pose = malloc(16 * sizeof *pose), *jacobian = malloc(6 * dof * sizeof *jacobian);
    double *q = malloc(slots * dof * sizeof *q), *nearest = malloc(dof * sizeof *nearest);
    double *limits = malloc(2 * dof * sizeof *limits);
    uint8_t *status = malloc(slots);
    char explained[200], cut[8];
    const double *q7 = dof == 7 ? &arm->q[6] : NULL;

    SUCCEEDS(irbkin_robot_limits(robot, limits, 2 * dof));
    LAW(same(limits, arm->limits, 2 * dof));
    SUCCEEDS(irbkin_fk(robot, arm->q, dof, pose));
    LAW(same(pose, arm->pose, 16));
    for (int frame = IRBKIN_FRAME_BASE; frame <= IRBKIN_FRAME_TOOL; frame++) {
        SUCCEEDS(irbkin_jacobian(robot, arm->q, dof, frame, jacobian, 6 * dof));
        LAW(same(jacobian, arm->jacobian[frame], 6 * dof));
    }
    SUCCEEDS(irbkin_ik(robot, pose, q7, q, slots * dof, status, slots, &found));
    LAW(found == arm->found && same(q, arm->solutions, slots * dof));
    LAW(memcmp(status, arm->status, slots) == 0);
    SUCCEEDS(irbkin_ik(robot, pose, q7, q, slots * dof, status, slots, NULL));
    SUCCEEDS(irbkin_explain(robot, pose, q7, explained, sizeof explained));
    LAW(strcmp(explained, arm->explained) == 0);
    SUCCEEDS(irbkin_explain(robot, pose, q7, cut, sizeof cut));
    LAW(strlen(cut) == 7 && strncmp(cut, explained, 7) == 0);
    SUCCEEDS(irbkin_ik_nearest(robot, pose, arm->seed, arm->weights, nearest, dof));
    LAW(same(nearest, arm->nearest, dof));

    free(pose), free(jacobian), free(q), free(nearest), free(limits), free(status);
}

static void a_batch_has_the_answers_of_the_rust_crate(const IrbkinRobot *robot) {
    size_t count = COUNT(MANY_JOINTS) / 6;
    double *poses = malloc(sizeof MANY_POSES), *q = malloc(sizeof MANY_SOLUTIONS);
    uint8_t *status = malloc(sizeof MANY_STATUS);
    bool *collides = malloc(sizeof MANY_COLLIDE);
    for (size_t threads = 0; threads < 3; threads++) {
        SUCCEEDS(
            irbkin_fk_batch(robot, MANY_JOINTS, COUNT(MANY_JOINTS), poses, 16 * count, threads));
        LAW(same(poses, MANY_POSES, 16 * count));
        poses[16 * 7] = NAN;
        SUCCEEDS(
            irbkin_ik_batch(robot, poses, count, NULL, q, 48 * count, status, 8 * count, threads));
        LAW(same(q, MANY_SOLUTIONS, 48 * count) && memcmp(status, MANY_STATUS, 8 * count) == 0);
        LAW(status[8 * 7] == IRBKIN_STATUS_INVALID && status[8 * 6] & IRBKIN_STATUS_FOUND);
    }
    IrbkinBox wall = {"wall", {0.4, 2.0, 0.5}, {0}};
    memcpy(wall.pose, WALL, sizeof WALL);
    IrbkinCell *cell;
    SUCCEEDS(irbkin_cell_of_boxes(&wall, 1, 0.01, &cell));
    SUCCEEDS(irbkin_collides(robot, cell, MANY_JOINTS, count, collides, 1));
    LAW(memcmp(collides, MANY_COLLIDE, count) == 0);
    SUCCEEDS(irbkin_collides(robot, NULL, MANY_JOINTS, count, collides, 1));
    LAW(memcmp(collides, MANY_FOLD, count) == 0 && memcmp(collides, MANY_COLLIDE, count) != 0);
    irbkin_cell_free(cell);
    free(poses), free(q), free(status), free(collides);
}

static void follow_and_plan_have_the_answers_of_the_rust_crate(const IrbkinRobot *robot) {
    enum { count = COUNT(LINE_BREAKS) };
    double q[6 * count], angles[count];
    int32_t slots[count];
    bool breaks[count];
    IrbkinPlanReport report;
    IrbkinPlanOptions options = {0};
    IrbkinBox wall = {"wall", {0.4, 2.0, 0.5}, {0}};
    memcpy(wall.pose, WALL, sizeof WALL);
    IrbkinCell *cell;
    SUCCEEDS(irbkin_cell_of_boxes(&wall, 1, 0.01, &cell));
    options.rotation_steps = 9, options.rotation_lower = -0.5, options.rotation_upper = 0.5;

    SUCCEEDS(irbkin_follow(robot, LINE_POSES, count, SEED, 6, q, 6 * count, breaks));
    LAW(same(q, LINE_FOLLOWED, 6 * count) && memcmp(breaks, LINE_BREAKS, count) == 0);
    REFUSED(irbkin_follow(robot, FAR_POSES, count, SEED, 6, q, 6 * count, breaks), BROKEN_PATH,
            FAR_BREAK);
    LAW(same(q, FAR_FOLLOWED, 6 * count) && memcmp(breaks, FAR_BREAKS, count) == 0);
    LAW(strlen(FAR_BREAK) > 0 && strlen(LINE_BREAK) == 0);

    options.cell = cell;
    SUCCEEDS(irbkin_plan(robot, LINE_POSES, count, &options, q, 6 * count, angles, slots, &report));
    LAW(same(q, LINE_PLANNED, 6 * count) && same(angles, LINE_ANGLES, count));
    LAW(memcmp(slots, LINE_SLOTS, sizeof slots) == 0 && report.certified);
    LAW(report.cost == LINE_REPORT.cost && report.bottleneck == LINE_REPORT.bottleneck);
    options.cell = NULL;
    REFUSED(irbkin_plan(robot, FAR_POSES, count, &options, q, 6 * count, NULL, slots, &report),
            BROKEN_PATH, FAR_NO_PLAN);
    LAW(same(q, FAR_PLANNED, 6 * count) && memcmp(slots, FAR_SLOTS, sizeof slots) == 0);
    LAW(report.breaks == FAR_REPORT.breaks && report.breaks > 0 && strlen(FAR_NO_PLAN) > 0);

    // Ends that are given are kept, and the times too.
    double times[count];
    for (int i = 0; i < count; i++) times[i] = i;
    IrbkinPlanOptions kept = {.start = SEED, .times = times};
    SUCCEEDS(irbkin_plan(robot, LINE_POSES, count, &kept, q, 6 * count, NULL, NULL, NULL));
    for (int i = 0; i < 6; i++) LAW(fabs(q[i] - SEED[i]) < 1e-9);
    times[1] = 0.0;
    REFUSED(irbkin_plan(robot, LINE_POSES, count, &kept, q, 6 * count, NULL, NULL, NULL),
            INVALID_PLAN, "times[1]");
    irbkin_cell_free(cell);
}

static void confdata_have_the_answers_of_the_rust_crate(const IrbkinRobot *robot, const Arm *arm) {
    int32_t confdata[4];
    double q[6];
    SUCCEEDS(irbkin_configuration(robot, arm->q, 6, confdata));
    LAW(memcmp(confdata, CONFDATA, sizeof confdata) == 0);
    SUCCEEDS(irbkin_ik_configured(robot, arm->pose, confdata, NULL, NULL, q, 6));
    LAW(same(q, CONFIGURED, 6));
    SUCCEEDS(irbkin_ik_configured(robot, arm->pose, confdata, arm->seed, NULL, q, 6));
    confdata[0] = 3;
    REFUSED(irbkin_ik_configured(robot, arm->pose, confdata, NULL, NULL, q, 6), NO_CONFIGURATION,
            "3, ");
}

static void null_is_refused(const IrbkinRobot *robot, const Arm *arm) {
    double pose[16], q[48];
    uint8_t status[8];
    bool collides[1];
    IrbkinRobot *made;
    IrbkinCell *cell;
    REFUSED(irbkin_robot_named(NULL, &made), INVALID_ARGUMENT, "name is NULL");
    LAW(made == NULL);
    REFUSED(irbkin_robot_named("UR5e", NULL), INVALID_ARGUMENT, "made is NULL");
    REFUSED(irbkin_robot_from_urdf(NULL, NULL, NULL, &made), INVALID_ARGUMENT, "urdf is NULL");
    REFUSED(irbkin_robot_from_mdh(NULL, 24, &made), INVALID_ARGUMENT, "rows is NULL");
    REFUSED(irbkin_robot_from_sdh(NULL, 28, &made), INVALID_ARGUMENT, "rows is NULL");
    REFUSED(irbkin_robot_from_opw(NULL, &made), INVALID_ARGUMENT, "parameters is NULL");
    REFUSED(irbkin_robot_with_tool(NULL, TOOL, &made), INVALID_ARGUMENT, "robot is NULL");
    REFUSED(irbkin_robot_with_tool(robot, NULL, &made), INVALID_ARGUMENT, "tool is NULL");
    REFUSED(irbkin_robot_with_base(robot, NULL, &made), INVALID_ARGUMENT, "base is NULL");
    REFUSED(irbkin_robot_with_limits(robot, NULL, 12, &made), INVALID_ARGUMENT, "limits is NULL");
    REFUSED(irbkin_robot_with_approximate_body(NULL, &made), INVALID_ARGUMENT, "robot is NULL");
    LAW(irbkin_robot_dof(NULL) == 0 && irbkin_robot_slot_count(NULL) == 0);
    LAW(irbkin_robot_name(NULL) == NULL);
    REFUSED(irbkin_robot_limits(robot, NULL, 12), INVALID_ARGUMENT, "limits is NULL");
    REFUSED(irbkin_fk(NULL, arm->q, 6, pose), INVALID_ARGUMENT, "robot is NULL");
    REFUSED(irbkin_fk(robot, NULL, 6, pose), INVALID_ARGUMENT, "q is NULL");
    REFUSED(irbkin_fk(robot, arm->q, 6, NULL), INVALID_ARGUMENT, "pose is NULL");
    REFUSED(irbkin_jacobian(robot, arm->q, 6, 0, NULL, 36), INVALID_ARGUMENT, "jacobian is NULL");
    REFUSED(irbkin_ik(robot, NULL, NULL, q, 48, status, 8, NULL), INVALID_ARGUMENT, "pose is NULL");
    REFUSED(irbkin_ik(robot, arm->pose, NULL, NULL, 48, status, 8, NULL), INVALID_ARGUMENT,
            "q is NULL");
    REFUSED(irbkin_ik(robot, arm->pose, NULL, q, 48, NULL, 8, NULL), INVALID_ARGUMENT,
            "status is NULL");
    REFUSED(irbkin_explain(robot, arm->pose, NULL, NULL, 9), INVALID_ARGUMENT, "text is NULL");
    REFUSED(irbkin_ik_nearest(robot, arm->pose, NULL, NULL, q, 6), INVALID_ARGUMENT,
            "seed is NULL");
    REFUSED(irbkin_ik_nearest(robot, arm->pose, arm->q, NULL, NULL, 6), INVALID_ARGUMENT,
            "q is NULL");
    REFUSED(irbkin_configuration(robot, arm->q, 6, NULL), INVALID_ARGUMENT, "confdata is NULL");
    REFUSED(irbkin_ik_configured(robot, arm->pose, NULL, NULL, NULL, q, 6), INVALID_ARGUMENT,
            "confdata is NULL");
    REFUSED(irbkin_ik_configured(robot, arm->pose, CONFDATA, NULL, NULL, NULL, 6), INVALID_ARGUMENT,
            "q is NULL");
    REFUSED(irbkin_fk_batch(robot, NULL, 6, pose, 16, 1), INVALID_ARGUMENT, "q is NULL");
    REFUSED(irbkin_ik_batch(robot, NULL, 1, NULL, q, 48, status, 8, 1), INVALID_ARGUMENT,
            "poses is NULL");
    REFUSED(irbkin_follow(robot, NULL, 1, arm->q, 6, q, 6, NULL), INVALID_ARGUMENT,
            "poses is NULL");
    REFUSED(irbkin_plan(robot, arm->pose, 1, NULL, NULL, 6, NULL, NULL, NULL), INVALID_ARGUMENT,
            "q is NULL");
    REFUSED(irbkin_cell_of_boxes(NULL, 1, 0.0, &cell), INVALID_ARGUMENT, "boxes is NULL");
    REFUSED(irbkin_cell_of_boxes(NULL, 0, 0.0, NULL), INVALID_ARGUMENT, "made is NULL");
    REFUSED(irbkin_collides(NULL, NULL, q, 1, collides, 1), INVALID_ARGUMENT, "robot is NULL");
    irbkin_robot_free(NULL);
    irbkin_cell_free(NULL);
}

static void numbers_that_are_no_poses_and_no_angles_are_refused(IrbkinRobot *const *robots) {
    double pose[16], q[56], angles[7] = {0};
    uint8_t status[8];
    bool collides[1];
    IrbkinRobot *made;
    IrbkinBox box = {"box", {0.1, NAN, 0.1}, {0}};
    IrbkinCell *cell;
    const IrbkinRobot *robot = robots[0];
    angles[2] = NAN;
    REFUSED(irbkin_fk(robot, angles, 6, pose), INVALID_JOINTS,
            "q[2] is NaN rad, it must be finite");
    REFUSED(irbkin_jacobian(robot, angles, 6, 0, q, 36), INVALID_JOINTS, "q[2] is NaN");
    REFUSED(irbkin_configuration(robot, angles, 6, (int32_t[4]){0}), INVALID_JOINTS, "q[2] is NaN");
    REFUSED(irbkin_collides(robot, NULL, angles, 1, collides, 1), INVALID_JOINTS, "joint 3 is NaN");
    REFUSED(irbkin_ik_nearest(robot, ARMS[0].pose, angles, NULL, q, 6), INVALID_JOINTS,
            "seed[2] is NaN");
    angles[2] = 1e300;
    REFUSED(irbkin_fk(robot, angles, 6, pose), INVALID_JOINTS, "its size at most");
    REFUSED(irbkin_ik(robots[1], ARMS[1].pose, angles + 2, q, 56, status, 8, NULL), INVALID_JOINTS,
            "q7: joint 7 is 1e300 rad");
    REFUSED(irbkin_jacobian(robot, ARMS[0].q, 6, 2, q, 36), INVALID_ARGUMENT,
            "frame is 2, it must be 0 (base) or 1 (tool)");
    memcpy(pose, ARMS[0].pose, sizeof pose);
    pose[3] = NAN;
    REFUSED(irbkin_ik(robot, pose, NULL, q, 48, status, 8, NULL), INVALID_POSE,
            "pose[0, 3] is NaN");
    REFUSED(irbkin_robot_with_tool(robot, pose, &made), INVALID_POSE, "tool: pose[0, 3] is NaN");
    REFUSED(irbkin_follow(robot, pose, 1, ARMS[0].q, 6, q, 6, NULL), INVALID_POSE,
            "poses[0]: pose[0, 3] is NaN");
    REFUSED(irbkin_plan(robot, pose, 1, NULL, q, 6, NULL, NULL, NULL), INVALID_POSE, "poses[0]: ");
    pose[3] = 500.0;
    SUCCEEDS(irbkin_ik(robot, pose, NULL, q, 48, status, 8, NULL));
    REFUSED(irbkin_ik_nearest(robot, pose, ARMS[0].q, NULL, q, 6), UNREACHABLE, "beyond reach");
    pose[0] = -pose[0];
    REFUSED(irbkin_ik(robot, pose, NULL, q, 48, status, 8, NULL), INVALID_POSE, "orthonormal");
    memcpy(box.pose, WALL, sizeof WALL);
    REFUSED(irbkin_cell_of_boxes(&box, 1, 0.0, &cell), INVALID_BODY, "boxes[0]: ");
    LAW(cell == NULL);
    REFUSED(irbkin_cell_of_boxes(NULL, 0, -1.0, &cell), INVALID_BODY, "margin");
    REFUSED(irbkin_robot_named("IRB 9999", &made), UNKNOWN_ROBOT, "IRB 9999");
    REFUSED(irbkin_robot_from_urdf("<robot/>", NULL, NULL, &made), INVALID_MODEL, "");
    REFUSED(irbkin_robot_from_opw(&(IrbkinOpwParameters){0}, &made), INVALID_MODEL, "");
}

static void another_length_is_refused(IrbkinRobot *const *robots) {
    const IrbkinRobot *robot = robots[0], *panda = robots[1];
    double pose[16], q[56];
    uint8_t status[8];
    IrbkinRobot *made;
    REFUSED(irbkin_fk(robot, ARMS[0].q, 5, pose), INVALID_ARGUMENT,
            "q has 5 elements, it must have 6");
    REFUSED(irbkin_fk(robot, ARMS[0].q, 0, pose), INVALID_ARGUMENT, "q has 0 elements");
    REFUSED(irbkin_jacobian(robot, ARMS[0].q, 6, 0, q, 42), INVALID_ARGUMENT,
            "jacobian has 42 elements, it must have 36");
    REFUSED(irbkin_ik(robot, ARMS[0].pose, NULL, q, 47, status, 8, NULL), INVALID_ARGUMENT,
            "q has 47 elements, it must have 48");
    REFUSED(irbkin_ik(robot, ARMS[0].pose, NULL, q, 48, status, 7, NULL), INVALID_ARGUMENT,
            "status has 7 elements, it must have 8");
    REFUSED(irbkin_ik(panda, ARMS[1].pose, NULL, q, 56, status, 8, NULL), INVALID_JOINTS, "q7");
    REFUSED(irbkin_ik(robot, ARMS[0].pose, q, q, 48, status, 8, NULL), INVALID_JOINTS, "joint 7");
    REFUSED(irbkin_ik_nearest(robot, ARMS[0].pose, ARMS[0].q, NULL, q, 7), INVALID_ARGUMENT,
            "seed has 7 elements, it must have 6");
    REFUSED(irbkin_ik_batch(panda, ARMS[1].pose, 1, NULL, q, 56, status, 8, 1), INVALID_ARGUMENT,
            "angles has 0 elements, it must have 1");
    REFUSED(irbkin_ik_batch(robot, pose, SIZE_MAX / 4, NULL, q, 48, status, 8, 1), INVALID_ARGUMENT,
            "poses has");
    REFUSED(irbkin_ik_batch(robot, q, 1, NULL, q + 8, 48, status, 8, 1), INVALID_ARGUMENT,
            "poses overlaps q: they must be apart");
    REFUSED(irbkin_fk_batch(robot, q, 6, q + 5, 16, 1), INVALID_ARGUMENT, "q overlaps poses");
    REFUSED(irbkin_robot_from_mdh(MDH, 20, &made), INVALID_ARGUMENT,
            "rows_len is 20, it must be 24");
    REFUSED(irbkin_robot_with_limits(robot, LIMITS, 11, &made), INVALID_ARGUMENT,
            "limits has 11 elements, it must have 12");
    REFUSED(irbkin_explain(robot, ARMS[0].pose, NULL, (char *)q, 0), INVALID_ARGUMENT,
            "text_len is 0");
    REFUSED(irbkin_follow(robot, ARMS[0].pose, 1, ARMS[0].q, 6, q, 5, NULL), INVALID_ARGUMENT,
            "q has 5 elements, it must have 6");
    SUCCEEDS(irbkin_follow(robot, NULL, 0, ARMS[0].q, 6, NULL, 0, NULL));
    REFUSED(irbkin_plan(robot, NULL, 0, NULL, NULL, 0, NULL, NULL, NULL), INVALID_PLAN, "");
}

static void an_arm_of_a_table_collides_once_it_has_a_body(IrbkinRobot *const *robots) {
    bool collides;
    IrbkinRobot *with_body;
    REFUSED(irbkin_collides(robots[3], NULL, ARMS[3].q, 1, &collides, 1), INVALID_BODY, "no body");
    SUCCEEDS(irbkin_robot_with_approximate_body(robots[3], &with_body));
    SUCCEEDS(irbkin_collides(with_body, NULL, ARMS[3].q, 1, &collides, 1));
    LAW(!collides);
    irbkin_robot_free(with_body);
}

int main(int argc, char **argv) {
    if (argc != 2) return 2;
    LAW(strlen(irbkin_last_error()) == 0);
    IrbkinRobot *robots[COUNT(ARMS)];
    char *urdf = content(argv[1]);
    make_robots(urdf, robots);
    free(urdf);
    for (size_t i = 0; i < COUNT(ARMS); i++) {
        an_arm_has_the_answers_of_the_rust_crate(robots[i], &ARMS[i]);
    }
    a_batch_has_the_answers_of_the_rust_crate(robots[0]);
    follow_and_plan_have_the_answers_of_the_rust_crate(robots[0]);
    confdata_have_the_answers_of_the_rust_crate(robots[0], &ARMS[0]);
    null_is_refused(robots[0], &ARMS[0]);
    numbers_that_are_no_poses_and_no_angles_are_refused(robots);
    another_length_is_refused(robots);
    an_arm_of_a_table_collides_once_it_has_a_body(robots);
    for (size_t i = 0; i < COUNT(ARMS); i++) irbkin_robot_free(robots[i]);
    printf("irbkin %s in C: %d comparisons and refusals hold\n", irbkin_version(), laws);
}
