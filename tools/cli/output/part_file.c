/* SPDX-License-Identifier: MIT */
/* A file that appears under its name only when it is complete. */
#include "output/part_file.h"

#include <errno.h>
#include <signal.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* What a signal must remove. A signal handler has no other way to know it; written only while signals are without effect on it. */
static char part_name[4096];

static void remove_part(int signal_number)
{
    if (part_name[0] != '\0') {
        (void)unlink(part_name);
    }
    (void)signal(signal_number, SIG_DFL);
    (void)raise(signal_number);
}

static void on_signals(void (*handler)(int))
{
    static const int numbers[] = {SIGINT, SIGTERM, SIGHUP};
    for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++) {
        struct sigaction before;
        /* One that is ignored, as under nohup, stays so. */
        if (sigaction(numbers[k], NULL, &before) == 0 && before.sa_handler != SIG_IGN) {
            (void)signal(numbers[k], handler);
        }
    }
}

FILE *part_file_open(const char *name)
{
    struct stat about;
    if (stat(name, &about) == 0 && !S_ISREG(about.st_mode)) {
        return fopen(name, "w");
    }
    if ((size_t)snprintf(part_name, sizeof part_name, "%s.part", name) >= sizeof part_name) {
        part_name[0] = '\0';
        errno = ENAMETOOLONG;
        return NULL;
    }
    FILE *file = fopen(part_name, "w");
    if (file == NULL) {
        part_name[0] = '\0';
        return NULL;
    }
    on_signals(remove_part);
    return file;
}

bool part_file_finish(FILE *file, const char *name)
{
    const bool closed = fclose(file) == 0;
    const bool named = part_name[0] == '\0' || (closed && rename(part_name, name) == 0);
    if (!named && part_name[0] != '\0') {
        const int error = errno;
        (void)unlink(part_name);
        errno = error;
    }
    on_signals(SIG_DFL);
    part_name[0] = '\0';
    return closed && named;
}

void part_file_drop(FILE *file)
{
    (void)fclose(file);
    if (part_name[0] != '\0') {
        (void)unlink(part_name);
        on_signals(SIG_DFL);
        part_name[0] = '\0';
    }
}
