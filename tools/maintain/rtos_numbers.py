#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Reads what the image of port/freertos counts about itself, from QEMU's monitor: rtos_numbers.py SOCKET ADDRESS

ADDRESS is that of `rtos_numbers` (port/freertos/rtos_numbers.h). Exit status 1 if the counts are not what they must be.
"""

import re
import socket
import sys

FIELDS = ("hub_stack", "hub_stack_free", "beat_stack", "beat_stack_free", "beats", "wrong_beats", "sleeps")


def read_words(path, address, count):
    """`count` words of memory; the monitor answers in lines of up to four."""
    with socket.socket(socket.AF_UNIX) as monitor:
        monitor.settimeout(10)
        monitor.connect(path)
        answer = ""
        # The prompt comes once at the start and once when the answer is complete.
        for prompts in (1, 2):
            while answer.count("(qemu)") < prompts:
                piece = monitor.recv(65536)
                if not piece:
                    raise OSError("the emulator has ended")
                answer += piece.decode("ascii", "replace")
            if prompts == 1:
                monitor.sendall(f"xp /{count}xw {address:#x}\n".encode())
    lines = re.findall(r"^[0-9a-f]{8,16}:((?: 0x[0-9a-f]{8})+)", answer.replace("\r", ""), re.MULTILINE)
    words = [int(word, 16) for line in lines for word in line.split()]
    if len(words) != count:
        raise OSError(f"{len(words)} words instead of {count}")
    return words


def complaints(numbers):
    """What is wrong with the counts."""
    if numbers["beats"] < 1024:
        yield "the task of high priority hardly ran"
    if numbers["wrong_beats"] > 0:
        yield f"{numbers['wrong_beats']} times a register of the FPU was lost between tasks"
    if numbers["sleeps"] == 0:
        yield "the processor never slept"
    for task in ("hub", "beat"):
        if numbers[f"{task}_stack_free"] * 8 < numbers[f"{task}_stack"]:
            yield f"the stack of the task {task} is nearly full"


def main():
    numbers = dict(zip(FIELDS, read_words(sys.argv[1], int(sys.argv[2], 16), len(FIELDS))))
    for task in ("hub", "beat"):
        size, free = numbers[f"{task}_stack"], numbers[f"{task}_stack_free"]
        print(f"stack of the task {task}: {size - free} of {size} bytes used")
    print(f"the task of high priority ran {numbers['beats']} times, {numbers['wrong_beats']} times with a wrong result;",
          f"slept {numbers['sleeps']} times")
    found = list(complaints(numbers))
    for line in found:
        print(line, file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
