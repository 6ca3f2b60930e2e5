/* SPDX-License-Identifier: MIT */
/* The sender's end of the wire to a hub. */
#include "run/hub_link.h"

#include <errno.h>
#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

#define UNIX_PREFIX "unix:"
#define TCP_PREFIX "tcp:"

static bool starts_with(const char *text, const char *prefix)
{
    return strncmp(text, prefix, strlen(prefix)) == 0;
}

static bool fail(hub_link_t *link, const char *what)
{
    (void)snprintf(link->error, sizeof link->error, "%s", what);
    return false;
}

int64_t hub_link_clock_us(void)
{
    struct timespec now = {0, 0};
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000000 + now.tv_nsec / 1000;
}

bool hub_link_target_ok(const char *target)
{
    if (starts_with(target, UNIX_PREFIX)) {
        return target[strlen(UNIX_PREFIX)] != '\0';
    }
    if (starts_with(target, TCP_PREFIX)) {
        const char *colon = strrchr(target, ':');
        return colon > target + strlen(TCP_PREFIX) && colon[1] != '\0';
    }
    return target[0] == '/';
}

static bool open_unix(hub_link_t *link, const char *path)
{
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    if (strlen(path) >= sizeof address.sun_path) {
        return fail(link, strerror(ENAMETOOLONG));
    }
    memcpy(address.sun_path, path, strlen(path));
    link->descriptor = socket(AF_UNIX, SOCK_STREAM, 0);
    if (link->descriptor < 0 || connect(link->descriptor, (const struct sockaddr *)&address, sizeof address) != 0) {
        return fail(link, strerror(errno));
    }
    return true;
}

/* Tries one address. */
static bool connect_to(hub_link_t *link, const struct addrinfo *address)
{
    link->descriptor = socket(address->ai_family, address->ai_socktype, address->ai_protocol);
    if (link->descriptor < 0) {
        return false;
    }
    if (connect(link->descriptor, address->ai_addr, address->ai_addrlen) == 0) {
        /* Frames are small and each of them counts: no waiting for more. */
        const int on = 1;
        (void)setsockopt(link->descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
        return true;
    }
    const int error = errno;
    hub_link_close(link);
    errno = error;
    return false;
}

static bool open_tcp(hub_link_t *link, const char *target)
{
    char host[256];
    const char *colon = strrchr(target, ':');
    if ((size_t)(colon - target) >= sizeof host) {
        return fail(link, strerror(ENAMETOOLONG));
    }
    memcpy(host, target, (size_t)(colon - target));
    host[colon - target] = '\0';
    const struct addrinfo hints = {.ai_family = AF_UNSPEC, .ai_socktype = SOCK_STREAM};
    struct addrinfo *found = NULL;
    const int status = getaddrinfo(host, colon + 1, &hints, &found);
    if (status != 0) {
        return fail(link, gai_strerror(status));
    }
    bool connected = false;
    for (const struct addrinfo *at = found; at != NULL && !connected; at = at->ai_next) {
        connected = connect_to(link, at);
    }
    const int error = errno;
    freeaddrinfo(found);
    return connected || fail(link, strerror(error));
}

static bool speed_of(unsigned long baud, speed_t *speed)
{
    static const struct {
        unsigned long baud;
        speed_t speed;
    } SPEEDS[] = {{9600, B9600},   {19200, B19200},   {38400, B38400},
                  {57600, B57600}, {115200, B115200}, {230400, B230400}};
    for (size_t k = 0; k < sizeof SPEEDS / sizeof SPEEDS[0]; k++) {
        if (SPEEDS[k].baud == baud) {
            *speed = SPEEDS[k].speed;
            return true;
        }
    }
    return false;
}

/* Bytes as they are: 8 bits, no parity, one stop bit, no flow control, nothing translated. */
static bool open_serial(hub_link_t *link, const char *path, unsigned long baud)
{
    struct termios settings;
    speed_t speed = B0;
    link->descriptor = open(path, O_RDWR | O_NOCTTY | O_NONBLOCK);
    if (link->descriptor < 0 || tcgetattr(link->descriptor, &settings) != 0) {
        return fail(link, strerror(errno));
    }
    if (!speed_of(baud, &speed)) {
        return fail(link, "this baud rate is not supported");
    }
    settings.c_iflag = IGNBRK;
    settings.c_oflag = 0;
    settings.c_lflag = 0;
    settings.c_cflag = CS8 | CREAD | CLOCAL;
    settings.c_cc[VMIN] = 1;
    settings.c_cc[VTIME] = 0;
    if (cfsetispeed(&settings, speed) != 0 || cfsetospeed(&settings, speed) != 0 ||
        tcsetattr(link->descriptor, TCSANOW, &settings) != 0 || tcflush(link->descriptor, TCIOFLUSH) != 0) {
        return fail(link, strerror(errno));
    }
    return true;
}

static bool open_target(hub_link_t *link, const char *target, unsigned long baud)
{
    if (starts_with(target, UNIX_PREFIX)) {
        return open_unix(link, target + strlen(UNIX_PREFIX));
    }
    if (starts_with(target, TCP_PREFIX)) {
        return open_tcp(link, target + strlen(TCP_PREFIX));
    }
    return open_serial(link, target, baud);
}

bool hub_link_open(hub_link_t *link, const char *target, unsigned long baud)
{
    *link = (hub_link_t){.target = target, .descriptor = -1};
    if (!open_target(link, target, baud)) {
        return false;
    }
    const int flags = fcntl(link->descriptor, F_GETFL);
    if (flags < 0 || fcntl(link->descriptor, F_SETFL, flags | O_NONBLOCK) != 0) {
        return fail(link, strerror(errno));
    }
    link->heard_us = hub_link_clock_us();
    return true;
}

void hub_link_listen(hub_link_t *link, hub_frame_t *on_frame, void *context)
{
    link->on_frame = on_frame;
    link->context = context;
}

/* Hello begins the hub's numbers anew; nothing before it is of this session. */
static void take_frame(hub_link_t *link, const frame_t *frame)
{
    if (frame->version != FRAME_VERSION) {
        link->speaks = frame->version;
        return;
    }
    if (frame->type == FRAME_HELLO) {
        link->linked = true;
        frame_link_start(&link->from_hub, frame->sequence);
    } else if (!link->linked || frame_link_count(&link->from_hub, frame->sequence) != FRAME_TAKEN) {
        return;
    }
    link->heard_us = hub_link_clock_us();
    uint32_t limit = 0;
    if (frame->type == FRAME_CREDIT && message_read_number(frame, &limit)) {
        link->limit = limit;
    }
    link->on_frame(link->context, frame);
}

static bool read_some(hub_link_t *link)
{
    uint8_t bytes[4096];
    const ssize_t got = read(link->descriptor, bytes, sizeof bytes);
    if (got == 0) {
        return fail(link, "the hub has closed the connection");
    }
    if (got < 0) {
        return errno == EAGAIN || errno == EINTR || fail(link, strerror(errno));
    }
    for (ssize_t k = 0; k < got; k++) {
        frame_t frame;
        const frame_event_t event = frame_decode(&link->decoder, bytes[k], &frame);
        if (event == FRAME_GOOD) {
            take_frame(link, &frame);
        } else if (event == FRAME_BAD) {
            link->from_hub.counts.corrupted++;
        }
    }
    return true;
}

/* Waits until something can be read, or `also` is possible, or the time is over. */
static bool wait_for(hub_link_t *link, short also, int64_t us)
{
    struct pollfd about = {.fd = link->descriptor, .events = (short)(POLLIN | also)};
    /* Rounded up, so that a short time is not a busy loop. */
    const int ready = poll(&about, 1, (int)((us + 999) / 1000));
    if (ready < 0) {
        return errno == EINTR || fail(link, strerror(errno));
    }
    return (about.revents & ~POLLOUT) == 0 || read_some(link);
}

bool hub_link_wait(hub_link_t *link, int64_t us)
{
    return wait_for(link, 0, us);
}

/* A second is long for a socket or a serial line; silence is judged elsewhere. */
#define WRITE_WAIT_US 1000000
#define WRITE_WAITS 10

bool hub_link_send(hub_link_t *link, frame_type_t type, const frame_writer_t *payload)
{
    uint8_t wire[FRAME_WIRE_MAX];
    const size_t size = frame_encode(wire, type, link->next, payload->bytes, payload->size);
    size_t done = 0;
    for (int waits = 0; done < size;) {
        const ssize_t wrote = write(link->descriptor, wire + done, size - done);
        if (wrote > 0) {
            done += (size_t)wrote;
            continue;
        }
        if (wrote < 0 && errno != EAGAIN && errno != EINTR) {
            return fail(link, strerror(errno));
        }
        if (++waits > WRITE_WAITS) {
            return fail(link, "the hub takes no bytes");
        }
        if (!wait_for(link, POLLOUT, WRITE_WAIT_US)) {
            return false;
        }
    }
    link->next++;
    return true;
}

int64_t hub_link_silence_us(const hub_link_t *link)
{
    return hub_link_clock_us() - link->heard_us;
}

void hub_link_close(hub_link_t *link)
{
    if (link->descriptor >= 0) {
        (void)close(link->descriptor);
    }
    link->descriptor = -1;
}
