/* SPDX-License-Identifier: MIT */
/* QEMU plugin: counts the instructions between marks, exactly, and says which functions the worst stretch spent them in.
 *
 * A stretch begins where a function named replay_mark_* other than replay_mark_end is entered, and ends at
 * replay_mark_end. Output, to the file given as `out=FILE`: one line `push|step|update COUNT` for each stretch, and at the
 * end `worst KIND COUNT FUNCTION` lines and one `cycles LOW HIGH INSTRUCTIONS` over all stretches: what the instructions executed
 * take by the tables of timings that Texas Instruments prints for the Cortex-M4F (SWCU192: instruction set, FPU instruction set,
 * load/store timings), without wait states. LOW: loads follow each other, a taken branch refills the pipeline in one cycle; HIGH:
 * every load takes two, every branch is taken and refills in three, every result of the FPU is waited for. Instructions are counted
 * by translated block, as QEMU executes them.
 *
 * Debian's QEMU has plugins but no header for them, so the few prototypes needed stand here. */
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef uint64_t plugin_id_t;
struct qemu_plugin_tb;
struct qemu_plugin_insn;
enum { NO_REGISTERS = 0 };
void qemu_plugin_register_vcpu_tb_trans_cb(plugin_id_t, void (*)(plugin_id_t, struct qemu_plugin_tb *));
void qemu_plugin_register_vcpu_tb_exec_cb(struct qemu_plugin_tb *, void (*)(unsigned, void *), int, void *);
void qemu_plugin_register_atexit_cb(plugin_id_t, void (*)(plugin_id_t, void *), void *);
size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb *);
struct qemu_plugin_insn *qemu_plugin_tb_get_insn(const struct qemu_plugin_tb *, size_t);
char *qemu_plugin_insn_disas(const struct qemu_plugin_insn *);
const char *qemu_plugin_insn_symbol(const struct qemu_plugin_insn *);
uint64_t qemu_plugin_insn_vaddr(const struct qemu_plugin_insn *);
extern __attribute__((visibility("default"))) int qemu_plugin_version;
__attribute__((visibility("default"))) int qemu_plugin_install(plugin_id_t id, const void *info, int argc, char **argv);

int qemu_plugin_version = 1;

enum { MAX_FUNCTIONS = 2000, KINDS = 3 };
typedef enum { KIND_PUSH, KIND_STEP, KIND_UPDATE, KIND_END, KIND_NONE } kind_t;
static const char *const KIND_NAMES[KINDS] = {"push", "step", "update"};

typedef struct {
    uint32_t low, high;
} cycles_t;

typedef struct {
    cycles_t cycles;
    uint32_t instructions;
    uint32_t function;
    kind_t mark;
} block_t;

static FILE *out;
static char *names[MAX_FUNCTIONS];
static uint32_t functions;
static uint32_t now[MAX_FUNCTIONS];
static uint32_t worst[KINDS][MAX_FUNCTIONS];
static uint64_t worst_total[KINDS];
static uint64_t total;
static uint64_t all_low, all_high, all_instructions;
static kind_t running = KIND_NONE;

static uint32_t function_number(const char *name)
{
    name = (name == NULL || name[0] == '\0') ? "?" : name;
    for (uint32_t k = 0; k < functions; ++k) {
        if (strcmp(names[k], name) == 0) {
            return k;
        }
    }
    if (functions == MAX_FUNCTIONS) {
        return MAX_FUNCTIONS - 1;
    }
    names[functions] = strdup(name);
    return functions++;
}

static kind_t mark_of(const char *name)
{
    static const char *const MARKS[] = {"replay_mark_push", "replay_mark_step", "replay_mark_update",
                                        "replay_mark_end"};
    for (int k = 0; name != NULL && k <= KIND_END; ++k) {
        if (strcmp(name, MARKS[k]) == 0) {
            return (kind_t)k;
        }
    }
    return KIND_NONE;
}

static bool begins(const char *text, const char *with)
{
    return strncmp(text, with, strlen(with)) == 0;
}

/* Words that a multiple load or store moves: its list names every register; a double one is two words. */
static uint32_t listed(const char *text)
{
    uint32_t count = 0;
    const char *at = strchr(text, '{');
    while (at != NULL && *at != '}') {
        const char *const name = at + 1 + strspn(at + 1, " ");
        count += (*name == 'd') ? 2 : 1;
        at = strpbrk(name, ",}");
    }
    return count;
}

static cycles_t cycles_of(const char *text)
{
    static const char *const MULTIPLE[] = {"push", "pop", "ldm", "stm", "vpush", "vpop", "vldm", "vstm"};
    for (size_t k = 0; k < sizeof MULTIPLE / sizeof MULTIPLE[0]; ++k) {
        if (begins(text, MULTIPLE[k])) {
            const uint32_t count = listed(text);
            const uint32_t refill = (strstr(text, "pc") != NULL) ? 1 : 0;
            return (cycles_t){1 + count + refill, 1 + count + (3 * refill)};
        }
    }
    if (begins(text, "vdiv") || begins(text, "vsqrt")) {
        return (cycles_t){14, 15};
    }
    if (begins(text, "vmla") || begins(text, "vmls") || begins(text, "vnml") || begins(text, "vfm") ||
        begins(text, "vfnm")) {
        return (cycles_t){3, 4};
    }
    if (begins(text, "vldr") || begins(text, "vstr") || begins(text, "ldrd") || begins(text, "strd")) {
        return begins(text, "v") ? (cycles_t){2, 2} : (cycles_t){2, 3};
    }
    if (begins(text, "v")) {
        return (cycles_t){1, 2};
    }
    if (begins(text, "udiv") || begins(text, "sdiv")) {
        return (cycles_t){2, 12};
    }
    if (begins(text, "ldr") || begins(text, "str")) {
        return (cycles_t){1, 2};
    }
    if (begins(text, "cb") || (begins(text, "b") && !begins(text, "bic") && !begins(text, "bf"))) {
        const bool always = begins(text, "b.w") || begins(text, "b ") || begins(text, "bl ") || begins(text, "bx");
        return (cycles_t){always ? 2 : 1, 4};
    }
    return (cycles_t){1, 1};
}

static void executed(unsigned cpu, void *data)
{
    (void)cpu;
    const block_t *const block = data;
    if (block->mark == KIND_NONE) {
        if (running != KIND_NONE) {
            total += block->instructions;
            now[block->function] += block->instructions;
            all_low += block->cycles.low;
            all_high += block->cycles.high;
            all_instructions += block->instructions;
        }
        return;
    }
    if (block->mark == KIND_END && running != KIND_NONE) {
        fprintf(out, "%s %llu\n", KIND_NAMES[running], (unsigned long long)total);
        if (total > worst_total[running]) {
            worst_total[running] = total;
            memcpy(worst[running], now, sizeof(now));
        }
    }
    running = (block->mark == KIND_END) ? KIND_NONE : block->mark;
    total = 0;
    memset(now, 0, functions * sizeof(now[0]));
}

static void translated(plugin_id_t id, struct qemu_plugin_tb *tb)
{
    (void)id;
    const char *const name = qemu_plugin_insn_symbol(qemu_plugin_tb_get_insn(tb, 0));
    block_t *const block = malloc(sizeof(*block)); /* as long as the translated code, that is, to the end */
    block->instructions = (uint32_t)qemu_plugin_tb_n_insns(tb);
    block->function = function_number(name);
    block->mark = mark_of(name);
    block->cycles = (cycles_t){0, 0};
    for (size_t k = 0; k < block->instructions; ++k) {
        char *const text = qemu_plugin_insn_disas(qemu_plugin_tb_get_insn(tb, k));
        const cycles_t one = cycles_of(text);
        block->cycles.low += one.low;
        block->cycles.high += one.high;
        free(text);
    }
    qemu_plugin_register_vcpu_tb_exec_cb(tb, executed, NO_REGISTERS, block);
}

static void ended(plugin_id_t id, void *data)
{
    (void)id;
    (void)data;
    for (int kind = 0; kind < KINDS; ++kind) {
        for (uint32_t k = 0; k < functions; ++k) {
            if (worst[kind][k] > 0) {
                fprintf(out, "worst %s %u %s\n", KIND_NAMES[kind], worst[kind][k], names[k]);
            }
        }
    }
    fprintf(out, "cycles %llu %llu %llu\n", (unsigned long long)all_low, (unsigned long long)all_high,
            (unsigned long long)all_instructions);
    fclose(out);
}

int qemu_plugin_install(plugin_id_t id, const void *info, int argc, char **argv)
{
    (void)info;
    if (argc != 1 || strncmp(argv[0], "out=", 4) != 0 || (out = fopen(argv[0] + 4, "w")) == NULL) {
        return 1;
    }
    qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
    qemu_plugin_register_atexit_cb(id, ended, NULL);
    return 0;
}
