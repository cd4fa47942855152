// An arm at joint angles, and what irbkin answers: the header that expected.rs prints has some.
#ifndef IRBKIN_TEST_ARM_H
#define IRBKIN_TEST_ARM_H

#include <irbkin.h>

typedef struct {
    const char *name;
    size_t dof, slot_count;
    double q[IRBKIN_MOST_JOINTS];
    double pose[16];
    double jacobian[2][6 * IRBKIN_MOST_JOINTS];
    double solutions[IRBKIN_MOST_SLOTS * IRBKIN_MOST_JOINTS];
    uint8_t status[IRBKIN_MOST_SLOTS];
    size_t found;
    const char *explained;
    double seed[IRBKIN_MOST_JOINTS];
    double weights[IRBKIN_MOST_JOINTS];
    double nearest[IRBKIN_MOST_JOINTS];
    double limits[2 * IRBKIN_MOST_JOINTS];
} Arm;

#endif
