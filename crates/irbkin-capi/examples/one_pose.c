// All solutions of a pose of an IRB 2600, and the one that is nearest to where the arm is:
// cc one_pose.c $(pkg-config --cflags --libs irbkin)
#include <irbkin.h>
#include <stdio.h>

// Print joint angles [deg].
static void print(const double *q) {
    for (int joint = 0; joint < 6; joint++) {
        printf(" %8.3f", q[joint] * 57.29577951308232);
    }
    printf("\n");
}

static int failed(void) {
    fprintf(stderr, "%s\n", irbkin_last_error());
    return 1;
}

int main(void) {
    IrbkinRobot *robot;
    if (irbkin_robot_named("IRB 2600-12/1.65", &robot) != IRBKIN_CODE_OK) return failed();

    // z of the tool points down.
    const double pose[16] = {1, 0, 0, 0.85, 0, -1, 0, 0.32, 0, 0, -1, 0.64, 0, 0, 0, 1};
    double q[8 * 6];
    uint8_t status[8];
    size_t found;
    if (irbkin_ik(robot, pose, NULL, q, 8 * 6, status, 8, &found) != IRBKIN_CODE_OK)
        return failed();
    printf("%s: %zu solutions\n", irbkin_robot_name(robot), found);
    for (int slot = 0; slot < 8; slot++) {
        if (status[slot] & IRBKIN_STATUS_FOUND) {
            printf("slot %d, %s the limits:", slot,
                   status[slot] & IRBKIN_STATUS_WITHIN_LIMITS ? " inside" : "outside");
            print(q + 6 * slot);
        }
    }

    const double here[6] = {0.3, 0.2, 0.1, 0.0, 0.9, 0.0};
    if (irbkin_ik_nearest(robot, pose, here, NULL, q, 6) != IRBKIN_CODE_OK) return failed();
    printf("nearest:                ");
    print(q);
    irbkin_robot_free(robot);
    return 0;
}
