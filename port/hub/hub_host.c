/* SPDX-License-Identifier: MIT */
/* The hub on a PC: serves the same code as a board over a socket, one sender after the other.
 *
 *     jointcal_hub [--flash FILE] [--cut-after N] unix:PATH | tcp:PORT
 *
 * Prints `listening` when senders may connect. A TCP port of 0 takes a free one; the line then tells which.
 *
 * --flash: calibrations are kept in FILE, two slots of 4 KiB, which is made if there is none; it may be killed at any moment.
 * --cut-after: the power goes after N pieces of work and accesses to flash: ends at once, exit status 3. */
#include "file_flash.h"
#include "hub.h"

#include <arpa/inet.h>
#include <errno.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <time.h>
#include <unistd.h>

/* Exit status of a cut. */
#define CUT 3
/* A hub with a clock has work without packets. */
#define WAKE_MS 10

/* What is left until the power goes; below zero: it stays. */
typedef struct {
    long left;
} power_t;

/* Ends the program if the power goes. */
static bool use_power(void *context)
{
    power_t *const power = context;
    if (power->left == 0) {
        _exit(CUT);
    }
    power->left -= (power->left > 0) ? 1 : 0;
    return true;
}

static uint64_t now_us(void)
{
    struct timespec now;
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000000u + (uint64_t)now.tv_nsec / 1000u;
}

static int trouble(const char *what)
{
    (void)fprintf(stderr, "jointcal_hub: %s: %s\n", what, strerror(errno));
    return -1;
}

static int listen_unix(const char *path)
{
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    if (strlen(path) >= sizeof address.sun_path) {
        errno = ENAMETOOLONG;
        return trouble(path);
    }
    memcpy(address.sun_path, path, strlen(path));
    const int server = socket(AF_UNIX, SOCK_STREAM, 0);
    if (server < 0 || bind(server, (const struct sockaddr *)&address, sizeof address) != 0 || listen(server, 1) != 0) {
        return trouble(path);
    }
    (void)printf("listening\n");
    return server;
}

/* On this machine only. */
static int listen_tcp(const char *port)
{
    struct sockaddr_in address = {.sin_family = AF_INET, .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    address.sin_port = htons((uint16_t)strtoul(port, NULL, 10));
    socklen_t size = sizeof address;
    const int server = socket(AF_INET, SOCK_STREAM, 0);
    const int on = 1;
    if (server < 0 || setsockopt(server, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) != 0 ||
        bind(server, (const struct sockaddr *)&address, sizeof address) != 0 || listen(server, 1) != 0 ||
        getsockname(server, (struct sockaddr *)&address, &size) != 0) {
        return trouble(port);
    }
    (void)printf("listening on %u\n", (unsigned)ntohs(address.sin_port));
    return server;
}

static bool write_all(int peer, const uint8_t *bytes, size_t size)
{
    while (size > 0) {
        const ssize_t wrote = write(peer, bytes, size);
        if (wrote < 0 && errno == EINTR) {
            continue;
        }
        if (wrote <= 0) {
            return false;
        }
        bytes += wrote;
        size -= (size_t)wrote;
    }
    return true;
}

/* Does all the work that there is and sends what comes of it. */
static bool work(hub_t *hub, power_t *power, int peer)
{
    uint8_t bytes[HUB_OUT_BYTES];
    for (bool more = true; more;) {
        (void)use_power(power);
        more = hub_work(hub);
        size_t size = 0;
        if (!more || hub_send_count(hub) > HUB_OUT_BYTES / 2u) {
            while (size < sizeof bytes && hub_send(hub, &bytes[size])) {
                size++;
            }
            more = more || hub_waiting(hub);
        }
        if (!write_all(peer, bytes, size)) {
            return false;
        }
    }
    return true;
}

/* What has come, or nothing for a while. False: the sender has gone. */
static bool receive(hub_t *hub, int peer)
{
    uint8_t bytes[4096];
    struct pollfd wait = {.fd = peer, .events = POLLIN};
    const int ready = poll(&wait, 1, WAKE_MS);
    hub_time(hub, now_us());
    if (ready == 0 || (ready < 0 && errno == EINTR)) {
        return true;
    }
    const ssize_t got = read(peer, bytes, sizeof bytes);
    if (got < 0 && errno == EINTR) {
        return true;
    }
    for (ssize_t k = 0; k < got; k++) {
        hub_receive(hub, bytes[k]);
    }
    return got > 0;
}

static void serve(hub_t *hub, power_t *power, int peer)
{
    bool is_there = true;
    while (is_there) {
        is_there = receive(hub, peer) && (!hub_waiting(hub) || work(hub, power, peer));
    }
}

/* What the command line says. */
typedef struct {
    const char *flash;
    const char *address;
    power_t power;
} options_t;

static bool read_count(const char *text, long *count)
{
    char *end = NULL;
    errno = 0;
    *count = strtol(text, &end, 10);
    return errno == 0 && end != text && *end == '\0' && *count >= 0;
}

static bool read_options(int argc, char **argv, options_t *options)
{
    *options = (options_t){.power = {-1}};
    int at = 1;
    for (; at + 1 < argc; at += 2) {
        if (strcmp(argv[at], "--flash") == 0) {
            options->flash = argv[at + 1];
        } else if (strcmp(argv[at], "--cut-after") != 0 || !read_count(argv[at + 1], &options->power.left)) {
            return false;
        }
    }
    options->address = (at < argc) ? argv[at] : "";
    return at + 1 == argc;
}

static int listen_at(const char *address)
{
    if (strncmp(address, "unix:", 5) == 0) {
        return listen_unix(address + 5);
    }
    if (strncmp(address, "tcp:", 4) == 0) {
        return listen_tcp(address + 4);
    }
    (void)fprintf(stderr, "usage: jointcal_hub [--flash FILE] [--cut-after N] unix:PATH | tcp:PORT\n");
    return -1;
}

int main(int argc, char **argv)
{
    static hub_t hub;
    static options_t options;
    static file_flash_t file;
    const bool ok = read_options(argc, argv, &options);
    /* Like a board, the hub keeps its state when a sender goes; the next one's start begins anew. */
    hub_init(&hub);
    if (ok && options.flash != NULL) {
        if (!file_flash_open(&file, options.flash, use_power, &options.power)) {
            (void)trouble(options.flash);
            return EXIT_FAILURE;
        }
        const jcal_flash_t flash = file_flash(&file);
        hub_set_flash(&hub, &flash, false);
    }
    const int server = listen_at(ok ? options.address : "");
    if (server < 0) {
        return EXIT_FAILURE;
    }
    (void)fflush(stdout);
    (void)signal(SIGPIPE, SIG_IGN);
    for (;;) {
        const int peer = accept(server, NULL, NULL);
        if (peer < 0) {
            (void)trouble("accept");
            return EXIT_FAILURE;
        }
        const int on = 1;
        (void)setsockopt(peer, IPPROTO_TCP, TCP_NODELAY, &on,
                         sizeof on); /* fails for unix sockets, which need it not */
        serve(&hub, &options.power, peer);
        (void)close(peer);
    }
}
