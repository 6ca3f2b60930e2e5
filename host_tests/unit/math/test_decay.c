/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of lib/math/decay.h.
#include "math/decay.h"

#include "unity.h"

#include <math.h>

void setUp(void)
{
}

void tearDown(void)
{
}

static void it_is_within_its_error_over_its_range(void)
{
    for (double x = 1e-6; x <= 5.0; x *= 1.0007) {
        const float argument = (float)x;
        const double expected = -expm1(-(double)argument);
        TEST_ASSERT_TRUE(fabs((double)jcal_taken_over(argument) - expected) < 5e-7 * expected);
    }
    TEST_ASSERT_TRUE(jcal_taken_over(0.0f) == 0.0f);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(it_is_within_its_error_over_its_range);
    return UNITY_END();
}
