#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What the library costs on a Cortex-M4F: code, state, stack, instructions. Writes docs/measurements/budget.md.

usage: tools/budget.py [--json] [--check] [--profile] [--recording FILE.csv] [--no-write]

--check fails if a limit of port/cortex_m/budgets.json is exceeded; --profile prints only the instructions and which
functions the worst calls spend them in. Instructions are counted exactly by a QEMU plugin; they are not cycles.
"""
import argparse
import json
import re
import statistics
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "python"))
from jointcal_tools import target  # noqa: E402

BUDGETS = target.PORT / "budgets.json"
PAGE = target.ROOT / "docs/measurements/budget.md"
M4F = target.PLATFORMS["m4f"]
ENGINES = {"stream": (), "window": ("REPLAY_WINDOW",)}
TWO_DOF, CENTER, CHAIN, SENSOR = "two_dof_stream", "center_stream", "chain", "sensor"
LEG = "leg"
FUNCTIONAL, AUTO, TWO_AXES = "functional_hinge", "hinge_auto", "two_axes"
PACKETS, PAIRING, LAG, HEALTH, BODY = "packets", "pairing", "lag", "health", "body"
DEFINED = {TWO_DOF: "REPLAY_TWO_DOF", CENTER: "REPLAY_CENTER", CHAIN: "REPLAY_CHAIN", LEG: "REPLAY_LEG", SENSOR: "REPLAY_SENSOR",
           FUNCTIONAL: "REPLAY_FUNCTIONAL", AUTO: "REPLAY_AUTO", TWO_AXES: "REPLAY_TWO_AXES",
           PACKETS: "REPLAY_PACKETS", PAIRING: "REPLAY_PAIRING", LAG: "REPLAY_LAG", HEALTH: "REPLAY_HEALTH",
           BODY: "REPLAY_BODY"}
INSTANCES, RATE_HZ = 16, 100
KNEE, ELBOW = "people_knee_long_R1", "people_elbow_B_JA_Fast"
SLICES_PER_S, TABLED_HZ = (200, 100, 50, 25), (50, 100)
LISTED = 8


def counts_of(plugin: Path, engine: str, samples: Path, definitions: tuple[str, ...]) -> tuple[dict, dict, dict]:
    """Counts of every call by kind (`cycles`: low, high, instructions), the worst call's by function, what the program printed."""
    name = f"replay_{engine}_{'_'.join(definitions).lower().replace('=', '_')}"
    image = target.build(M4F, name, (ENGINES.get(engine) or (() if engine in ENGINES else (DEFINED[engine],))) + definitions)
    out = target.WORK / "counts.txt"
    printed = target.run(M4F, image, samples, plugin, out)
    counts: dict[str, list[int]] = {}
    worst: dict[str, dict[str, int]] = {}
    for line in out.read_text().splitlines():
        cells = line.split()
        if cells[0] == "worst":
            worst.setdefault(cells[1], {})[cells[3]] = int(cells[2])
        elif cells[0] == "cycles":
            counts["cycles"] = [int(cell) for cell in cells[1:]]
        else:
            counts.setdefault(cells[0], []).append(int(cells[1]))
    return counts, worst, printed


def instructions(samples: Path) -> dict:
    """Per engine: counts of push, step and update, worst update by function, state bytes, painted stack."""
    plugin = target.build_plugin()
    found = {}
    for engine in ENGINES:
        counts, worst, printed = counts_of(plugin, engine, samples, ("REPLAY_STACK",))
        split, _, _ = counts_of(plugin, engine, samples, ("REPLAY_SPLIT",))
        found[engine] = {"counts": counts | split, "worst": worst["update"], **printed}
    return found


def print_profile(found: dict) -> None:
    for engine, of in found.items():
        for kind in ("update", "push", "step"):
            counts = of["counts"][kind]
            print(f"{engine} {kind}: max {max(counts)}, mean {statistics.mean(counts):.0f}, "
                  f"median {statistics.median(counts):.0f}, sample of the max {counts.index(max(counts))}")
        for name, count in sorted(of["worst"].items(), key=lambda item: -item[1]):
            print(f"    {count:8d}  {name}")


def code_of(level: str) -> dict[str, int]:
    """Bytes of code and constants per module of lib/."""
    objects = target.compile_objects(M4F, level)
    text = subprocess.run(["arm-none-eabi-size", *objects], check=True, capture_output=True, text=True).stdout
    return {cells[5].split("/lib/")[-1].split(".")[0].replace("/", "_"): int(cells[0]) for cells in (line.split() for line in text.splitlines()[1:])}


def linked_bytes(name: str, definitions: tuple[str, ...] = ()) -> int:
    """Code, constants and initial values of the hub program, as flashed."""
    image = target.build(M4F, name, definitions, "hub.c")
    text = subprocess.run(["arm-none-eabi-size", image], check=True, capture_output=True, text=True).stdout
    return sum(int(cell) for cell in text.splitlines()[1].split()[:2])


def sixteen(recording: Path) -> dict:
    """Sixteen engines in one image at 100 Hz: instructions of each tick, which updates all of them."""
    counts, _, printed = counts_of(target.build_plugin(), "stream", target.samples_file(recording, RATE_HZ),
                                   ("REPLAY_SIXTEEN",))
    ticks = counts["update"]
    busiest = max(sum(ticks[k:k + RATE_HZ]) for k in range(len(ticks) - RATE_HZ + 1))
    return {"sixteen_hinges_instructions_per_s_mean": round(statistics.mean(ticks) * RATE_HZ),
            "sixteen_hinges_instructions_per_s_busiest": busiest,
            "sixteen_hinges_instructions_per_tick_max": max(ticks),
            "sixteen_hinges_state_bytes": INSTANCES * printed["state"]}


def two_dof(stack: dict[str, int]) -> dict:
    """The 2-DoF stream engine, fed with orientations at 100 Hz."""
    recording = target.recordings(["rig_2D_05"], "two_dof_demo")[0]
    samples = target.orientations_file(recording, RATE_HZ)
    counts, _, printed = counts_of(target.build_plugin(), TWO_DOF, samples, ("REPLAY_STACK",))
    at_50, _, _ = counts_of(target.build_plugin(), TWO_DOF, target.orientations_file(recording, 50), ())
    return {f"{TWO_DOF}_push_instructions_max": max(counts["update"]),
            f"{TWO_DOF}_push_instructions_mean": round(statistics.mean(counts["update"])),
            f"{TWO_DOF}_push_instructions_50_hz_max": max(at_50["update"]),
            f"{TWO_DOF}_push_instructions_50_hz_mean": round(statistics.mean(at_50["update"])),
            f"{TWO_DOF}_state_bytes": printed["state"], f"{TWO_DOF}_stack_painted_bytes": printed["stack"],
            f"{TWO_DOF}_stack_call_graph_bytes": stack.get("jcal_two_dof_update", 0)}


def center(stack: dict[str, int]) -> dict:
    """The stream engine of the joint centre at 50 Hz and 100 Hz."""
    recording, found = target.recordings(["rig_3D_04"], "two_dof_demo")[0], {}
    for rate_hz in TABLED_HZ:
        counts, worst, printed = counts_of(target.build_plugin(), CENTER, target.samples_file(recording, rate_hz), ("REPLAY_STACK",))
        key = f"{CENTER}_push_instructions" + ("" if rate_hz == RATE_HZ else f"_{rate_hz}_hz")
        found |= {f"{key}_max": max(counts["update"]), f"{key}_mean": round(statistics.mean(counts["update"]))}
    found |= {f"{CENTER}_state_bytes": printed["state"], f"{CENTER}_stack_painted_bytes": printed["stack"],
              f"{CENTER}_stack_call_graph_bytes": stack.get("jcal_center_update", 0)}
    if "--profile-center" in sys.argv:
        for name, count in sorted(worst["update"].items(), key=lambda item: -item[1])[:15]:
            print(f"    {count:8d}  {name}")
    return found


def chain(stack: dict[str, int]) -> dict:
    """Hip and knee at 100 Hz: jcal_chain_push and jcal_chain_step together."""
    recording = target.recordings(["human_leg_left"], "chain_demo")[0]
    counts, _, printed = counts_of(target.build_plugin(), CHAIN, target.triples_file(recording, RATE_HZ), ("REPLAY_STACK",))
    return {f"{CHAIN}_push_instructions_max": max(counts["update"]),
            f"{CHAIN}_push_instructions_mean": round(statistics.mean(counts["update"])), f"{CHAIN}_state_bytes": printed["state"],
            f"{CHAIN}_stack_painted_bytes": printed["stack"],
            f"{CHAIN}_stack_call_graph_bytes": max(stack.get(f"jcal_chain_{name}", 0) for name in ("push", "step", "get"))}


def leg(stack: dict[str, int]) -> dict:
    """Hip and knee of a person at 100 Hz: jcal_leg_push with its three sensors, jcal_leg_step, and both with all slices that are due."""
    samples = target.triples_file(target.recordings(["human_leg_left"], "chain_demo")[0], RATE_HZ)
    counts, _, printed = counts_of(target.build_plugin(), LEG, samples, ("REPLAY_STACK",))
    split, _, _ = counts_of(target.build_plugin(), LEG, samples, ("REPLAY_SPLIT",))
    return {f"{LEG}_push_instructions_max": max(split["push"]), f"{LEG}_step_instructions_max": max(split["step"]),
            f"{LEG}_update_instructions_max": max(counts["update"]),
            f"{LEG}_update_instructions_mean": round(statistics.mean(counts["update"])),
            f"{LEG}_state_bytes": printed["state"], f"{LEG}_stack_painted_bytes": printed["stack"],
            f"{LEG}_stack_call_graph_bytes": max(stack.get(f"jcal_leg_{name}", 0) for name in ("push", "step", "update", "get"))}


def sensor(stack: dict[str, int]) -> dict:
    """The stage of one sensor at 100 Hz: jcal_sensor_push, also where no two distances of samples are the same."""
    recording = target.recordings(["human_knee_left"])[0]
    counts, _, printed = counts_of(target.build_plugin(), SENSOR, target.readings_file(recording, RATE_HZ), ("REPLAY_STACK",))
    uneven, _, _ = counts_of(target.build_plugin(), SENSOR, target.readings_file(recording, RATE_HZ, jitter_us=2000), ())
    return {f"{SENSOR}_step_instructions_max": max(counts["update"]),
            f"{SENSOR}_step_instructions_mean": round(statistics.mean(counts["update"])),
            f"{SENSOR}_step_instructions_median": round(statistics.median(counts["update"])),
            f"{SENSOR}_step_instructions_uneven_max": max(uneven["update"]),
            f"{SENSOR}_step_instructions_uneven_mean": round(statistics.mean(uneven["update"])),
            f"{SENSOR}_state_bytes": printed["state"], f"{SENSOR}_stack_painted_bytes": printed["stack"],
            f"{SENSOR}_stack_call_graph_bytes": stack.get("jcal_sensor_push", 0)}


def health(stack: dict[str, int]) -> dict:
    """The health of one sensor at 100 Hz: jcal_health_push."""
    recording = target.recordings(["human_knee_left"])[0]
    counts, worst, printed = counts_of(target.build_plugin(), HEALTH, target.readings_file(recording, RATE_HZ), ("REPLAY_STACK",))
    if "--profile" in sys.argv:
        for name, count in sorted(worst["update"].items(), key=lambda item: -item[1])[:LISTED]:
            print(f"{HEALTH} {count:8d}  {name}")
    return {f"{HEALTH}_push_instructions_max": max(counts["update"]), f"{HEALTH}_push_instructions_mean": round(statistics.mean(counts["update"])),
            f"{HEALTH}_push_instructions_median": round(statistics.median(counts["update"])),
            f"{HEALTH}_state_bytes": printed["state"], f"{HEALTH}_stack_painted_bytes": printed["stack"],
            f"{HEALTH}_stack_call_graph_bytes": max(stack.get(f"jcal_health_{name}", 0) for name in ("push", "get"))}


def wireless(engine: str, samples: Path, stack: dict[str, int], calls: tuple[str, str]) -> dict:
    """A stage between a sensor and joints at 100 Hz: each of its two calls, and both together per sample."""
    split, worst, _ = counts_of(target.build_plugin(), engine, samples, ("REPLAY_SPLIT",))
    _, _, printed = counts_of(target.build_plugin(), engine, samples, ("REPLAY_STACK",))
    if "--profile" in sys.argv:
        for kind in ("push", "step"):
            for name, count in sorted(worst[kind].items(), key=lambda item: -item[1])[:LISTED]:
                print(f"{engine} {kind} {count:8d}  {name}")
    found = {}
    for call, counts in zip(calls, (split["push"], split["step"]), strict=True):
        key = f"{engine}_{call}_instructions"
        found |= {f"{key}_max": max(counts), f"{key}_mean": round(statistics.mean(counts))}
    found[f"{engine}_sample_instructions_mean"] = round((sum(split["push"]) + sum(split["step"])) / printed["samples"])
    return found | {f"{engine}_state_bytes": printed["state"], f"{engine}_stack_painted_bytes": printed["stack"],
                    f"{engine}_stack_call_graph_bytes": max(stack.get(f"jcal_{engine}_{name}", 0) for name in (*calls, "get"))}


def wireless_stages(stack: dict[str, int]) -> dict:
    """Packets of one sensor (four raw readings each), pairs and lag of two, on a person's knee."""
    recording = target.recordings([KNEE])[0]
    pairs = target.samples_file(recording, RATE_HZ)
    return (wireless(PACKETS, target.readings_file(recording, RATE_HZ), stack, ("push", "pull"))
            | wireless(PAIRING, pairs, stack, ("push", "pull")) | wireless(LAG, pairs, stack, ("add", "step")))


def body(stack: dict[str, int]) -> dict:
    """Sixteen sensors and fifteen functional hinges: each hundredth of a second, packets and one step of 80 units. Once ready: without the search for lags."""
    samples = target.samples_file(target.recordings([KNEE])[0], RATE_HZ)
    counts, worst, printed = counts_of(target.build_plugin(), BODY, samples, ("REPLAY_STACK",))
    in_step, _, ready = counts_of(target.build_plugin(), BODY, samples, ("REPLAY_IN_STEP",))
    if "--profile" in sys.argv:
        for name, count in sorted(worst["update"].items(), key=lambda item: -item[1])[:LISTED]:
            print(f"    {count:8d}  {name}")
    once_ready = by_readiness(f"{BODY}_tick_instructions", in_step["update"], ready["before_ready"])
    return {f"{BODY}_tick_instructions_max": max(max(counts["update"]), max(in_step["update"])),
            f"{BODY}_tick_instructions_mean": round(statistics.mean(counts["update"])),
            **once_ready, f"{BODY}_state_bytes": printed["state"],
            f"{BODY}_stack_painted_bytes": printed["stack"],
            f"{BODY}_stack_call_graph_bytes": max(stack.get(f"jcal_body_{name}", 0) for name in ("step", "joint", "sensor", "advice", "sentence"))}


def by_readiness(key: str, counts: list[int], before_ready: int) -> dict:
    """Means of updates until the first that is ready, and of those from there on; all of them if there is none."""
    return {f"{key}_mean_until_ready": round(statistics.mean(counts[:before_ready] or counts)),
            f"{key}_mean_once_ready": round(statistics.mean(counts[before_ready:] or counts))}


def of_ticks(engine: str, prefix: str, recording: Path, stack: dict[str, int], last: str) -> dict:
    """A joint of ticks at 100 Hz, without its sensors: each add and each step; per sample both together."""
    samples = target.samples_file(recording, RATE_HZ)
    split, worst, shown = counts_of(target.build_plugin(), engine, samples, ("REPLAY_SPLIT", "REPLAY_SHOW_SLICES"))
    counts, _, printed = counts_of(target.build_plugin(), engine, samples, ("REPLAY_STACK",))
    if "--profile" in sys.argv:
        for slice_ in sorted(set(shown["slices"])):
            of = [count for number, count in zip(shown["slices"], split["step"]) if number == slice_]
            print(f"{engine}, slice {slice_}: {len(of)} times, max {max(of)}, mean {statistics.mean(of):.0f}")
        for name, count in sorted(worst["step"].items(), key=lambda item: -item[1])[:LISTED]:
            print(f"    {count:8d}  {name}")
    calls = [f"jcal_{prefix}_{name}" for name in ("add", "step", "get")] + [last]
    return {f"{engine}_add_instructions_max": max(split["push"]), f"{engine}_add_instructions_mean": round(statistics.mean(split["push"])),
            f"{engine}_step_instructions_max": max(split["step"]),
            f"{engine}_step_instructions_mean": round(sum(split["step"]) / printed["samples"]),
            **by_readiness(f"{engine}_sample_instructions", counts["update"], printed["before_ready"]),
            f"{engine}_sample_instructions_max": max(counts["update"]), f"{engine}_state_bytes": printed["state"],
            f"{engine}_stack_painted_bytes": printed["stack"],
            f"{engine}_stack_call_graph_bytes": max(stack.get(name, 0) for name in calls),
            f"{engine}_code_bytes": linked_bytes(f"hub_{prefix}", (f"HUB_{prefix.upper()}",)) - linked_bytes("hub_empty", ("HUB_EMPTY",))}


def functional(stack: dict[str, int]) -> dict:
    """The functional hinge on a knee."""
    return of_ticks(FUNCTIONAL, "functional", target.recordings([KNEE])[0], stack, "jcal_functional_flexion")


def two_axes(stack: dict[str, int]) -> dict:
    """A person's joint with two axes on an elbow: the ball joint, and axes from windows."""
    return of_ticks(TWO_AXES, "two_axes", target.recordings([ELBOW], "elbow_demo")[0], stack, "jcal_ball_relative")


def hinge_auto(stack: dict[str, int]) -> dict:
    """jcal_hinge_auto_update as a whole, on the same knee: both models and both sensors' stages."""
    samples = target.samples_file(target.recordings([KNEE])[0], RATE_HZ)
    counts, worst, printed = counts_of(target.build_plugin(), AUTO, samples, ("REPLAY_STACK",))
    if "--profile" in sys.argv:
        for name, count in sorted(worst["update"].items(), key=lambda item: -item[1])[:LISTED]:
            print(f"    {count:8d}  {name}")
    return {f"{AUTO}_update_instructions_max": max(counts["update"]),
            **by_readiness(f"{AUTO}_update_instructions", counts["update"], printed["before_ready"]),
            f"{AUTO}_state_bytes": printed["state"], f"{AUTO}_stack_painted_bytes": printed["stack"],
            f"{AUTO}_stack_call_graph_bytes": max(stack.get(f"jcal_hinge_auto_{name}", 0) for name in ("update", "get", "flexion"))}


def fewer_slices(recording: Path) -> dict:
    """Instructions of an update by slices_per_s and rate, on the first minute of the recording at that rate."""
    plugin, found = target.build_plugin(), {}
    for slices in SLICES_PER_S:
        for rate_hz in TABLED_HZ:
            samples = target.samples_file(recording, rate_hz)
            counts, _, _ = counts_of(plugin, "stream", samples, (f"REPLAY_SLICES={slices}",))
            key = f"hinge_stream_push_instructions_{slices}_slices_{rate_hz}_hz"
            found |= {f"{key}_max": max(counts["update"]), f"{key}_mean": round(statistics.mean(counts["update"]))}
    # At 25 slices and 100 Hz three updates in four have none.
    found["hinge_stream_push_without_slice_instructions"] = round(statistics.median(counts["update"]))
    return found


def stack_by_call_graph() -> tuple[dict[str, int], list[str]]:
    """Worst-case stack of each function from GCC's call graphs, and what they could not tell."""
    objects = target.compile_objects(M4F, "-O2", ("-fcallgraph-info=su",))
    frames: dict[str, int] = {}
    calls: dict[str, set[str]] = {}
    for graph in (Path(o).with_suffix(".ci") for o in objects):
        text = graph.read_text()
        for title, label in re.findall(r'node: { title: "([^"]+)" label: "([^"]+)"', text):
            size = re.search(r"(\d+) bytes \((\w+)", label)
            if size:
                frames[title] = int(size[1])
        for source, callee in re.findall(r'edge: { sourcename: "([^"]+)" targetname: "([^"]+)"', text):
            calls.setdefault(source, set()).add(callee)
    depth: dict[str, int] = {}

    def deepest(name: str) -> int:
        if name not in depth:
            depth[name] = frames.get(name, 0) + max((deepest(callee) for callee in calls.get(name, ())), default=0)
        return depth[name]

    unknown = sorted({c for of in calls.values() for c in of if c not in frames})
    return {name: deepest(name) for name in frames}, unknown


def measure(samples: Path, recording: Path) -> tuple[dict, dict]:
    found = instructions(samples)
    stack, unknown = stack_by_call_graph()
    code = {level: code_of(level) for level in ("-O2", "-Os")}
    numbers: dict = {"recording": recording.stem, "code_bytes": sum(code["-O2"].values()),
                     "code_bytes_os": sum(code["-Os"].values())}
    for engine, prefix in (("stream", "hinge"), ("window", "hinge_window")):
        of = found[engine]
        for kind in ("update", "push", "step"):
            counts = of["counts"][kind]
            key = f"hinge_{engine}_{'push' if kind == 'update' else kind + '_alone'}_instructions"
            numbers |= {f"{key}_max": max(counts), f"{key}_mean": round(statistics.mean(counts)),
                        f"{key}_median": round(statistics.median(counts))}
        numbers[f"hinge_{engine}_state_bytes"] = of["state"]
        numbers[f"hinge_{engine}_stack_painted_bytes"] = of["stack"]
        numbers[f"hinge_{engine}_stack_call_graph_bytes"] = stack.get(f"jcal_{prefix}_update", 0)
    numbers |= two_dof(stack) | center(stack) | chain(stack) | leg(stack) | sensor(stack) | functional(stack) | two_axes(stack)
    numbers |= hinge_auto(stack) | wireless_stages(stack) | health(stack) | body(stack)
    numbers["stack_bytes"] = max(value for key, value in numbers.items() if "_stack_" in key)
    numbers |= sixteen(recording)
    numbers["hub_flash_bytes"] = linked_bytes("hub") - linked_bytes("hub_empty", ("HUB_EMPTY",))
    numbers |= fewer_slices(recording)
    low, high, executed = found["stream"]["counts"]["cycles"]
    numbers["cycles_per_instruction"] = [round(low / executed, 2), round(high / executed, 2)]
    numbers["worst_push_by_function"] = dict(sorted(found["stream"]["worst"].items(), key=lambda item: -item[1])[:LISTED])
    numbers["not_in_call_graph"] = unknown
    return numbers, code


def exceeded(numbers: dict) -> list[str]:
    """A sentence for each limit that is exceeded; those within a stated allowance begin with `known`."""
    found = []
    for key, of in json.loads(BUDGETS.read_text()).items():
        if numbers[key] > of["limit"]:
            word = "known" if numbers[key] <= of.get("allowed", of["limit"]) else "EXCEEDED"
            found.append(f"{word}: {key} {numbers[key]} > {of['limit']}. {of.get('why', '')}".strip())
    return found


def page_of(numbers: dict, code: dict) -> str:
    low, high = numbers["cycles_per_instruction"]
    lines = ["# Cost on a Cortex-M4F", "",
             f"Written by `tools/budget.py`, recording {numbers['recording']}, arm-none-eabi-gcc, contraction off. `push` is",
             "push and step together, as in jcal_hinge_update. The window engine has N_max 125. `code_bytes` is the whole library;",
             "`hub_flash_bytes` what one stream engine, fed and read, adds to a linked image with unused sections dropped. Sixteen",
             "hinges: one image, one tick of 10 ms updates all, on the first minute of the recording interpolated to 100 Hz; all",
             "get the same samples, so that their busy moments coincide. `two_dof_stream`: the recording interpolated to 100 Hz (and 50),",
             "orientations by VQF, whose cost is not in these numbers (port/vqf/README.md has it). `sensor`: jcal_sensor_push, one sensor at 100 Hz;",
             "`uneven`: samples up to 2 ms off, so that coefficients change with each. `functional_hinge`: a person's knee at 100 Hz, ticks and",
             "steps without the stages of its sensors; `step_instructions_mean` is of all steps for a sample. `functional_hinge_code_bytes`: what two",
             "sensors and one such hinge add to a linked image. `two_axes`: the same of a person's elbow. `hinge_auto`: jcal_hinge_auto_update on the same knee, with all it contains. `packets`: of one sensor, four raw "
             "readings each; `pairing` and `lag`: of the same knee's two sensors, without their stages, one slice of the lag's work per sample. `health`: jcal_health_push, one sensor on a knee at 100 Hz. `body`: sixteen sensors and fifteen functional hinges on the same knee, a tick is a hundredth of a second with the packets that come and one step of 80 units, and the state has everything, packets that wait included. Sixteen hinges: in their busiest second that is "
             f"{numbers['sixteen_hinges_instructions_per_s_busiest'] * low / 1e6:.0f} to",
             f"{numbers['sixteen_hinges_instructions_per_s_busiest'] * high / 1e6:.0f} million cycles, by the estimate below, of 64 million.", "",
             "Instructions, not cycles; no board was measured. On paper, the instructions of the stream engine on this recording",
             f"take {low:.2f} to {high:.2f} cycles each on a Cortex-M4F without wait states: the mix that was executed, priced by the",
             "table of timings in Texas Instruments' document SWCU192 (1 cycle for an addition or multiplication of floats, 3 for",
             "both in one, 14 for a division or root, 2 for a load, 1 + N for N registers, 1 to 3 more for a taken branch); low",
             "if loads follow each other and branches are cheap, high if every load, branch and float result is waited for. Flash",
             "adds to that. The STM32F405 reads 128 bits at once through a prefetch and cache lines (reference manual RM0090,",
             "section 3); of the same scheme in the STM32L4 at 80 MHz ST's data sheet gives 3.42 CoreMark/MHz,",
             "which is what Arm names for the core itself, so next to nothing is lost in loops. The nRF52840 has an instruction cache",
             "that is off after reset (ICACHECNF of its NVMC); the pull requests RIOT 9400 and ariel-os 1163 measured what it",
             "brings: 1574 ticks fall to 1305 in the latter. `port/boards/nrf52840` switches it on. On a board, `DWT_CYCCNT` before and",
             "after a call tells the cycles.", "",
             "| quantity | value |", "|---|---|"]
    lines += [f"| {key} | {value} |" for key, value in numbers.items() if isinstance(value, int) and "_slices_" not in key]
    lines += ["", "Instructions of an update by `slices_per_s` of the config and rate of the samples, most and mean, on the first minute of",
              "the recording; [slices.md](slices.md) has what fewer slices cost in time to ready. An update without any slice or closing",
              f"block takes {numbers['hinge_stream_push_without_slice_instructions']} (median at 25 slices and 100 Hz).", "",
              "| slices per second | " + " | ".join(f"{rate} Hz, most | mean" for rate in TABLED_HZ) + " |", "|---|" + "---|---|" * len(TABLED_HZ)]
    lines += [f"| {slices} | " + " | ".join(f"{numbers[f'{key}_max']} | {numbers[f'{key}_mean']}" for key in
                                             (f"hinge_stream_push_instructions_{slices}_slices_{rate}_hz" for rate in TABLED_HZ))
              + " |" for slices in SLICES_PER_S]
    lines += ["", "Where the busiest update of the stream engine at 50 Hz spends its instructions (functions by themselves, inlined ones with",
              "their caller):", "", "| function | instructions |", "|---|---|"]
    lines += [f"| {name} | {count} |" for name, count in numbers["worst_push_by_function"].items()]
    lines += ["", "Not in the call graphs, counted as 0 bytes of stack: " + ", ".join(numbers["not_in_call_graph"]) + ".", "",
              "| module | -O2 | -Os |", "|---|---|---|"]
    lines += [f"| {name} | {size} | {code['-Os'][name]} |" for name, size in code["-O2"].items()]
    lines += ["", "Limits exceeded:", ""] + ([f"- {line}" for line in exceeded(numbers)] or ["- none"])
    return "\n".join(lines) + "\n"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for flag in ("--json", "--check", "--profile", "--no-write"):
        parser.add_argument(flag, action="store_true")
    parser.add_argument("--recording", type=Path)
    arguments = parser.parse_args()
    recording = arguments.recording or target.recordings(["rig_1D_04"])[0]
    samples = target.samples_file(recording)
    if arguments.profile:
        print_profile(instructions(samples))
        functional({})
        two_axes({})
        hinge_auto({})
        wireless_stages({})
        health({})
        body({})
        return 0
    numbers, code = measure(samples, recording)
    page = page_of(numbers, code)
    if not arguments.no_write:
        PAGE.write_text(page, encoding="utf-8")
    print(json.dumps(numbers, indent=4) if arguments.json else page)
    broken = [line for line in exceeded(numbers) if line.startswith("EXCEEDED")]
    for line in broken:
        print(line, file=sys.stderr)
    return 1 if arguments.check and broken else 0


if __name__ == "__main__":
    sys.exit(main())
