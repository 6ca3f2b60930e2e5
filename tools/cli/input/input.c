/* SPDX-License-Identifier: MIT */
/* The file or standard input that a recording is read from. */
#include "input/input.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static int fail(input_t *input, int error)
{
    input->error = error;
    return -1;
}

int input_open(input_t *input, const char *name)
{
    *input = (input_t){.name = name, .descriptor = STDIN_FILENO};
    if (strcmp(name, "-") != 0) {
        input->descriptor = open(name, O_RDONLY);
    }
    struct stat about;
    if (input->descriptor < 0 || fstat(input->descriptor, &about) != 0) {
        return fail(input, errno);
    }
    if (S_ISDIR(about.st_mode)) {
        input_close(input);
        return fail(input, EISDIR);
    }
    input->again = S_ISREG(about.st_mode) && input->descriptor != STDIN_FILENO;
    input->device = (uint64_t)about.st_dev;
    input->node = (uint64_t)about.st_ino;
    input->size = (S_ISREG(about.st_mode) && about.st_size > 0) ? (uint64_t)about.st_size : 0;
    return 0;
}

long input_read(void *context, char *buffer, size_t size)
{
    input_t *input = context;
    for (;;) {
        const ssize_t got = read(input->descriptor, buffer, size);
        if (got >= 0) {
            return (long)got;
        }
        if (errno != EINTR) {
            return fail(input, errno);
        }
    }
}

bool input_same(const input_t *a, const input_t *b)
{
    return a->device == b->device && a->node == b->node;
}

void input_close(input_t *input)
{
    if (input->descriptor > STDIN_FILENO) {
        (void)close(input->descriptor);
    }
}
