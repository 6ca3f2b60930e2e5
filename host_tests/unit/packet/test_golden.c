/* SPDX-License-Identifier: MIT */
/// @file
/// Packets against the float64 numpy reference, tools/maintain/make_golden.py: a sensor that is learnt, begins anew, and whose radio
/// becomes slower, with packets lost, late and twice.
#include "golden/packet.h"
#include "jointcal/packet.h"

#include "unity.h"

/* Heights above the line are floats of up to 0.1 s times 6e-8; the slope is the difference of two of them over 30 s and more. */
static const double DRIFT_TOL_PPM = 0.01;
/* Times are whole us, and the line's height is off by that drift over a minute. */
static const double TIME_TOL_US = 3.0;
/* A bound and a mean are sums of such heights. */
static const double BOUND_TOL_PPM = 0.02;
static const double JITTER_TOL_US = 1.0;

static jcal_packets_t packets;
static unsigned char storage[JCAL_PACKETS_STORAGE_BYTES(2, 16, JCAL_PACKET_SI)];

void setUp(void)
{
}

void tearDown(void)
{
}

static void start(void)
{
    jcal_packet_config_t config = jcal_packet_config_default();
    config.period_ns = GOLDEN_PERIOD_NS;
    config.counter_bits = GOLDEN_BITS;
    config.per_packet = 16;
    config.packets = 2;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_packets_init(&packets, &config, storage, sizeof storage));
}

static void push(const uint32_t *row)
{
    static const float zeros[96];
    const jcal_packet_t packet = {.arrival_us = row[0], .counter = row[1], .count = (uint8_t)row[2], .si = zeros};
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_packets_push(&packets, &packet));
}

static void assert_found(const double *expected)
{
    const unsigned count = (unsigned)expected[0];
    jcal_reading_t reading;
    for (unsigned k = 0; k < count; ++k) {
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_packets_pull(&packets, &reading));
        if ((k == 0) || (k + 1u == count)) {
            const double since_us = (double)(int64_t)(reading.t_us - golden_packets[0][0]);
            TEST_ASSERT_DOUBLE_WITHIN(TIME_TOL_US, expected[(k == 0) ? 1 : 2], since_us);
        }
    }
    if (count == 0) {
        TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_packets_pull(&packets, &reading));
    }
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_packets_pull(&packets, &reading));
    jcal_packets_status_t status;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_packets_get(&packets, &status));
    TEST_ASSERT_DOUBLE_WITHIN(DRIFT_TOL_PPM, expected[3], (double)status.drift_ppm);
    TEST_ASSERT_DOUBLE_WITHIN(BOUND_TOL_PPM, expected[4], (double)status.bound_ppm);
    TEST_ASSERT_DOUBLE_WITHIN(JITTER_TOL_US, expected[5], 1e6 * (double)status.jitter_s);
}

static void packets_become_what_the_reference_says(void)
{
    start();
    for (unsigned k = 0; k < GOLDEN_PACKETS; ++k) {
        push(golden_packets[k]);
        assert_found(golden_found[k]);
    }
    jcal_packets_status_t status;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_packets_get(&packets, &status));
    TEST_ASSERT_EQUAL_UINT32(golden_counts[0], status.readings);
    TEST_ASSERT_EQUAL_UINT32(golden_counts[1], status.lost);
    TEST_ASSERT_EQUAL_UINT32(golden_counts[2], status.late);
    TEST_ASSERT_EQUAL_UINT32(golden_counts[3], status.duplicate);
    TEST_ASSERT_EQUAL_UINT32(golden_counts[4], status.odd);
    TEST_ASSERT_EQUAL_UINT32(golden_counts[5], status.restarts);
    TEST_ASSERT_EQUAL_UINT32(golden_counts[6], status.steps);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(packets_become_what_the_reference_says);
    return UNITY_END();
}
