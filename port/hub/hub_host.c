/* SPDX-License-Identifier: MIT */
/* The hub on a PC: serves the same code as a board over a socket, one sender after the other.
 *
 *     jointcal_hub unix:PATH | tcp:PORT
 *
 * Prints `listening` when senders may connect. A TCP port of 0 takes a free one; the line then tells which. */
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
#include <unistd.h>

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
static bool work(hub_t *hub, int peer)
{
    uint8_t bytes[HUB_OUT_BYTES];
    for (bool more = true; more;) {
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

static void serve(hub_t *hub, int peer)
{
    uint8_t bytes[4096];
    for (;;) {
        const ssize_t got = read(peer, bytes, sizeof bytes);
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got <= 0) {
            return;
        }
        for (ssize_t k = 0; k < got; k++) {
            hub_receive(hub, bytes[k]);
        }
        if (!work(hub, peer)) {
            return;
        }
    }
}

int main(int argc, char **argv)
{
    static hub_t hub;
    int server = -1;
    if (argc == 2 && strncmp(argv[1], "unix:", 5) == 0) {
        server = listen_unix(argv[1] + 5);
    } else if (argc == 2 && strncmp(argv[1], "tcp:", 4) == 0) {
        server = listen_tcp(argv[1] + 4);
    } else {
        (void)fprintf(stderr, "usage: jointcal_hub unix:PATH | tcp:PORT\n");
    }
    if (server < 0) {
        return EXIT_FAILURE;
    }
    (void)fflush(stdout);
    (void)signal(SIGPIPE, SIG_IGN);
    /* Like a board, the hub keeps its state when a sender goes; the next one's start begins anew. */
    hub_init(&hub);
    for (;;) {
        const int peer = accept(server, NULL, NULL);
        if (peer < 0) {
            (void)trouble("accept");
            return EXIT_FAILURE;
        }
        const int on = 1;
        (void)setsockopt(peer, IPPROTO_TCP, TCP_NODELAY, &on,
                         sizeof on); /* fails for unix sockets, which need it not */
        serve(&hub, peer);
        (void)close(peer);
    }
}
