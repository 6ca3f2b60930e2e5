/* SPDX-License-Identifier: MIT */
/* Version macros and query agree. */
#include "jointcal/jointcal.h"

#include <unity.h>

#include <stdio.h>

void setUp(void)
{
}

void tearDown(void)
{
}

static void version_string_is_made_of_the_three_numbers(void)
{
    char expected[32];
    (void)snprintf(expected, sizeof expected, "%d.%d.%d", JCAL_VERSION_MAJOR, JCAL_VERSION_MINOR, JCAL_VERSION_PATCH);
    TEST_ASSERT_EQUAL_STRING(expected, JCAL_VERSION_STRING);
}

static void library_and_header_have_one_version(void)
{
    TEST_ASSERT_EQUAL_STRING(JCAL_VERSION_STRING, jcal_version());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(version_string_is_made_of_the_three_numbers);
    RUN_TEST(library_and_header_have_one_version);
    return UNITY_END();
}
