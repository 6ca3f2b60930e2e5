/* SPDX-License-Identifier: MIT */
/* Error messages. */
#include "output/message.h"

#include <errno.h>
#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void complain(const char *file, uint64_t line, uint64_t column, const char *format, ...)
{
    (void)fprintf(stderr, "%s:", file);
    if (line > 0) {
        (void)fprintf(stderr, "%" PRIu64 ":", line);
    }
    if (line > 0 && column > 0) {
        (void)fprintf(stderr, "%" PRIu64 ":", column);
    }
    (void)fputc(' ', stderr);
    va_list arguments;
    va_start(arguments, format);
    (void)vfprintf(stderr, format, arguments);
    va_end(arguments);
    (void)fputc('\n', stderr);
}

exit_status_t complain_output(const char *name)
{
    if (errno != EPIPE) {
        complain(name, 0, 0, "%s", strerror(errno));
    }
    return EXIT_TROUBLE;
}
