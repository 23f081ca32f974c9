#!/usr/bin/python3
"""Damages DICOM files at random and imports them, fifty at a time beside a good series: nothing may be lost with them.

import_mutants.py VICON DATA COUNT [SEED]

Of each batch the import must end by itself with 0, within the time and memory that one bad file may take, with a line
of JSON for its report, and the good series must be stored. Prints counts and the slowest batch; ends with 1 at a batch
that fails, whose files stay.
"""
import collections
import json
import os
import pathlib
import random
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
import time

BATCH, LONGEST_S, MEMORY_BYTES = 50, 10, 2 << 30
LARGEST_SOURCE = 600_000
GOOD_SLICES = 12


def sources(data):
    found = [path for kind in ("dicom", "hostile") for path in sorted((data / kind).rglob("*"))
             if path.is_file() and 0 < path.stat().st_size <= LARGEST_SOURCE and path.suffix not in (".py", ".md")]
    by_folder = collections.defaultdict(list)  # a folder of a hundred slices counts as one
    for path in found:
        by_folder[path.parent].append(path)
    return list(by_folder.values())


def place(dice, content):
    return dice.randrange(max(1, min(len(content), dice.choice([140, 400, 2000, 2000, 1 << 30]))))


def mutate(dice, content, other):
    content = bytearray(content)
    for _ in range(dice.choice([1, 1, 1, 2, 3, 8, 40])):
        at, kind = place(dice, content), dice.randrange(8)
        if not content:
            break
        if kind < 2:
            content[at] ^= 1 << dice.randrange(8)
        elif kind == 2:
            content[at] = dice.choice([0, 1, 0x20, 0x2c, 0x5c, 0x7f, 0x80, 0xff])
        elif kind == 3:
            content[at:at + 4] = struct.pack("<I", dice.choice([0, 1, 0xfffe, 0xffff, 0x10000, 0x7fffffff, 0xfffffffe, 0xffffffff]))
        elif kind == 4:
            del content[at:at + dice.choice([1, 2, 8, 100])]
        elif kind == 5:
            content[at:at] = dice.randbytes(dice.choice([1, 2, 8, 100]))
        elif kind == 6:
            begin = place(dice, other)
            content[at:at] = other[begin:begin + dice.choice([8, 64, 512, 4096])]
        else:
            del content[dice.randrange(len(content)):]
    return bytes(content)


def processor_seconds():
    """Of all that was run so far: how long one takes by the clock depends on what else the machine does."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def good_series(folder, template):
    """The first slices of a series of the data, under a study of their own: no mutant may belong to it."""
    for n, file in enumerate(template[:GOOD_SLICES]):
        (folder / f"good{n}").write_bytes(file.read_bytes().replace(b".3680043.2.1125.", b".3680043.9.9125."))


def main():
    vicon, data, count = sys.argv[1], pathlib.Path(sys.argv[2]), int(sys.argv[3])
    first = int(sys.argv[4]) if len(sys.argv) > 4 else int(time.time())
    good = data / "dicom" / "ct64"
    template = sorted(good.iterdir()) if good.is_dir() else []
    if len(template) < GOOD_SLICES:
        print("Skipped\nneeds ../shared/data/dicom")
        sys.exit(77)
    groups = sources(data)
    said, slowest, done, largest_mb = collections.Counter(), 0, 0, 0
    # The address sanitizer maps terabytes of shadow: then only what is said, lost and how long it takes is looked at.
    limit = resource.RLIM_INFINITY if b"__asan_init" in pathlib.Path(vicon).read_bytes() else MEMORY_BYTES
    root = pathlib.Path(tempfile.mkdtemp(prefix="vicon-mutants-"))
    while done < count:
        dice = random.Random(first + done)
        folder = root / "in"
        folder.mkdir()
        good_series(folder, template)
        for n in range(BATCH):
            source, other = (dice.choice(dice.choice(groups)).read_bytes() for _ in range(2))
            (folder / f"mutant{n:02}.dcm").write_bytes(mutate(dice, source, other))
        before = processor_seconds()
        try:
            run = subprocess.run([vicon, "--store", root / "store", "--json", "import", folder], capture_output=True, timeout=60,
                                 preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
        except subprocess.TimeoutExpired:
            sys.exit(f"batch {first} + {done}: over 60 s; its files are in {folder}")
        seconds = processor_seconds() - before
        largest_mb = max(largest_mb, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1000)
        try:
            lines = json.loads(run.stdout)["lines"]
        except (ValueError, KeyError) as e:
            lines, run.returncode = [], run.returncode or f"no report ({e})"
        stored = any(line["kind"] == "stored" for line in lines)
        if run.returncode != 0 or not stored or seconds > LONGEST_S:
            sys.exit(f"batch {first} + {done}: ended with {run.returncode} after {seconds:.1f} s of processor time, good series "
                     f"{'stored' if stored else 'LOST'}; its files are in {folder}\n{run.stderr.decode(errors='replace')[-2000:]}")
        said.update(line["kind"] for line in lines)
        slowest, done = max(slowest, seconds), done + BATCH
        shutil.rmtree(folder)
        shutil.rmtree(root / "store")
    shutil.rmtree(root)
    print(f"{done} mutants from seed {first}: no batch lost, slowest batch {slowest:.1f} s of processor time, at most {largest_mb:.0f} MB; "
          + ", ".join(f"{number} {kind}" for kind, number in said.most_common()))


main()
