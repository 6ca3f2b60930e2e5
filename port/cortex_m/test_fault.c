/* SPDX-License-Identifier: MIT */
/* Runs into a fault on purpose: the test runner must see exit status 99, not a time limit and not success. */
#include <stdlib.h>

int main(void)
{
    __asm volatile("udf #0");
    return EXIT_SUCCESS;
}
