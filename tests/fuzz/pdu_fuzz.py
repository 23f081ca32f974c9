#!/usr/bin/python3
"""Mutates real DICOM exchanges against a listener: C-ECHO, C-STORE and storage commitment, byte by byte and PDU by PDU.

pdu_fuzz.py LISTENER SECONDS [SEED]

LISTENER is fuzz_listener. Every so many exchanges a proper C-ECHO must be answered; at the end the listener must end in
order. Prints how many exchanges were made; ends with 1, and the seed of the exchange, when the listener died, hung or
grew.
"""
import pathlib
import random
import resource
import socket
import struct
import subprocess
import sys
import tempfile
import time

ECHO_CLASS, CT_CLASS, COMMITMENT = b"1.2.840.10008.1.1", b"1.2.840.10008.5.1.4.1.1.2", b"1.2.840.10008.1.20.1"
IMPLICIT, EXPLICIT = b"1.2.840.10008.1.2", b"1.2.840.10008.1.2.1"
SUCCESS = struct.pack("<HHIH", 0, 0x900, 2, 0)  # the element Status
ANSWER_S = 10          # a proper request is answered within
PROPER_EVERY = 50      # exchanges
LARGEST_MB = 500       # resident
# Where the address sanitizer notes what is allocated (x86-64): an eighth of every length that a peer claims, though
# nothing of the memory itself is touched. Two minutes found up to 2.2 GB there, and 80 MB elsewhere.
SANITIZERS_NOTES = range(0x7FFF8000, 0x10007FFF8000)


def item(kind, content):
    return struct.pack(">BxH", kind, len(content)) + content


def pdu(kind, content):
    return struct.pack(">BxI", kind, len(content)) + content


def associate(classes, syntaxes=(IMPLICIT, EXPLICIT)):
    contexts = b"".join(item(0x20, struct.pack("Bxxx", 2 * n + 1) + item(0x30, uid) + b"".join(item(0x40, one) for one in syntaxes))
                        for n, uid in enumerate(classes))
    user = item(0x50, item(0x51, struct.pack(">I", 16384)) + item(0x52, b"1.2.826.0.1.3680043.10.9.9") + item(0x55, b"FUZZ"))
    return pdu(1, struct.pack(">Hxx", 1) + b"VICON".ljust(16) + b"FUZZ".ljust(16) + bytes(32) +
               item(0x10, b"1.2.840.10008.3.1.1.1") + contexts + user)


def element(group, number, value):
    value += b"\0" if len(value) % 2 else b""
    return struct.pack("<HHI", group, number, len(value)) + value


def command(fields):
    body = b"".join(element(0, number, value) for number, value in fields)
    return element(0, 0, struct.pack("<I", len(body))) + body


def data(context, is_command, content, last=True):
    flags = (1 if is_command else 0) | (2 if last else 0)
    return pdu(4, struct.pack(">IBB", len(content) + 2, context, flags) + content)


def short(value):
    return struct.pack("<H", value)


def echo():
    return [associate([ECHO_CLASS]),
            data(1, True, command([(2, ECHO_CLASS), (0x100, short(0x30)), (0x110, short(1)), (0x800, short(0x101))])),
            pdu(5, bytes(4))]


def image(n):
    uid = b"1.2.826.0.1.3680043.10.9.2.%d" % n
    text = [(8, 0x16, CT_CLASS), (8, 0x18, uid), (8, 0x60, b"CT"), (0x10, 0x10, b"Doe^Jane"), (0x10, 0x20, b"P1"), (0x18, 0x50, b"2"),
            (0x20, 0xd, b"1.2.826.0.1.3680043.10.9"), (0x20, 0xe, b"1.2.826.0.1.3680043.10.9.2"), (0x20, 0x32, b"0\\0\\%d" % (2 * n)),
            (0x20, 0x37, b"1\\0\\0\\0\\1\\0")]
    numbers = [(0x28, 2, 1), (0x28, 0x10, 8), (0x28, 0x11, 8), (0x28, 0x100, 16), (0x28, 0x101, 12), (0x28, 0x102, 11), (0x28, 0x103, 0)]
    rest = [(0x28, 0x30, b"1\\1"), (0x28, 0x1052, b"-1024"), (0x28, 0x1053, b"1")]
    elements = text + [(g, e, short(v)) for g, e, v in numbers] + rest
    return uid, b"".join(element(*one) for one in sorted(elements)) + element(0x7fe0, 0x10, bytes(128))


def store(n):
    uid, content = image(n)
    fields = [(2, CT_CLASS), (0x100, short(1)), (0x110, short(1)), (0x700, short(0)), (0x800, short(1)), (0x1000, uid)]
    half = len(content) // 2 // 2 * 2
    return [associate([CT_CLASS]), data(1, True, command(fields)), data(1, False, content[:half], False), data(1, False, content[half:]),
            pdu(5, bytes(4))]


def commitment(n):
    reference = element(8, 0x1150, CT_CLASS) + element(8, 0x1155, image(n)[0])
    content = element(8, 0x1195, b"1.2.826.0.1.3680043.10.9.3.1") + element(8, 0x1199, struct.pack("<HHI", 0xfffe, 0xe000, len(reference)) + reference)
    fields = [(3, COMMITMENT), (0x100, short(0x130)), (0x110, short(1)), (0x800, short(1)), (0x1001, b"1.2.840.10008.1.20.1.1"), (0x1008, short(1))]
    return [associate([COMMITMENT], [IMPLICIT]), data(1, True, command(fields)), data(1, False, content), pdu(5, bytes(4))]


def mutated_bytes(dice, content):
    content = bytearray(content)
    for _ in range(dice.choice([1, 1, 2, 4, 16])):
        if not content:
            break
        at = dice.randrange(min(len(content), dice.choice([16, 128, 1 << 20])))
        kind = dice.randrange(6)
        if kind == 0:
            content[at] ^= 1 << dice.randrange(8)
        elif kind == 1:
            content[at] = dice.choice([0, 1, 0x7f, 0x80, 0xff, dice.randrange(256)])
        elif kind == 2:
            content[at:at + 4] = struct.pack(dice.choice(["<I", ">I"]), dice.choice([0, 1, 0xffff, 0x7fffffff, 0xfffffffe, 0xffffffff]))
        elif kind == 3:
            del content[at:at + dice.choice([1, 2, 8, 64])]
        elif kind == 4:
            content[at:at] = dice.randbytes(dice.choice([1, 2, 8, 64, 4096]))
        else:
            content[at:at] = content[at:at + dice.choice([4, 16, 256])]
    return bytes(content)


def mutated(dice, exchange):
    exchange = list(exchange)
    for _ in range(dice.choice([0, 0, 1])):
        kind, at = dice.randrange(4), dice.randrange(len(exchange))
        if kind == 0:
            del exchange[at]
        elif kind == 1:
            exchange.insert(at, exchange[dice.randrange(len(exchange))])
        elif kind == 2:
            dice.shuffle(exchange)
        else:
            exchange.insert(at, pdu(dice.randrange(256), dice.randbytes(dice.choice([0, 4, 100]))))
    if not exchange:
        return exchange
    for _ in range(dice.choice([1, 1, 2])):
        at = dice.randrange(len(exchange))
        exchange[at] = mutated_bytes(dice, exchange[at])
    return exchange


def send(port, exchange, dice):
    """Answers are not waited for longer than they take on a quiet machine: most mutants get none."""
    with socket.create_connection(("127.0.0.1", port), timeout=ANSWER_S) as link:
        try:
            for part in exchange:
                link.sendall(part)
                link.settimeout(dice.choice([0, 0.005, 0.05]) or 0.001)
                try:
                    if not link.recv(4096):
                        return
                except (TimeoutError, BlockingIOError):
                    pass
                link.settimeout(ANSWER_S)
        except (ConnectionError, TimeoutError):
            pass


def exactly(link, count):
    content = b""
    while len(content) < count:
        some = link.recv(count - len(content))
        if not some:
            raise ConnectionError("the listener closed the connection")
        content += some
    return content


def answers_to(port, exchange):
    with socket.create_connection(("127.0.0.1", port), timeout=ANSWER_S) as link:
        link.settimeout(ANSWER_S)
        kinds, content = [], b""
        for part in exchange:
            link.sendall(part)
            head = exactly(link, 6)
            kinds.append(head[0])
            content = exactly(link, struct.unpack(">I", head[2:])[0])
        return kinds, content


def resident_mb(process):
    kb, counts = 0, False
    for line in pathlib.Path(f"/proc/{process.pid}/smaps").read_text().splitlines():
        name, value = line.split()[:2]
        if not name.endswith(":"):
            counts = int(name.split("-")[0], 16) not in SANITIZERS_NOTES
        elif name == "Rss:" and counts:
            kb += int(value)
    return kb / 1000


def main():
    listener_program, seconds = sys.argv[1], float(sys.argv[2])
    first = int(sys.argv[3]) if len(sys.argv) > 3 else int(time.time())
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    exchanges, end = 0, time.monotonic() + seconds
    with tempfile.TemporaryDirectory() as folder:
        log = open(pathlib.Path(folder) / "log", "w+")
        listener = subprocess.Popen([listener_program, folder + "/store"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=log, text=True)
        port = int(listener.stdout.readline())

        def failed(why):
            log.seek(0)
            listener.kill()
            sys.exit(f"{why}; seeds {first} + {max(0, exchanges - PROPER_EVERY)} to {exchanges}\n{log.read()[-6000:]}")

        while time.monotonic() < end:
            dice = random.Random(first + exchanges)
            kind = dice.randrange(4)
            exchange = echo() if kind == 0 else commitment(dice.randrange(30)) if kind == 1 else store(dice.randrange(30))
            try:
                send(port, mutated(dice, exchange), dice)
            except OSError as e:
                failed(f"no connection: {e}")
            exchanges += 1
            if listener.poll() is not None:
                failed(f"the listener ended with {listener.returncode}")
            if exchanges % PROPER_EVERY == 0:
                ask = commitment(0)
                for name, proper in (("C-ECHO", echo()[:2]), ("request for commitment", [ask[0], ask[1] + ask[2]])):
                    try:
                        kinds, content = answers_to(port, proper)
                    except (OSError, struct.error, IndexError) as e:
                        failed(f"a proper {name} was not answered: {e}")
                    if kinds != [2, 4] or SUCCESS not in content:
                        failed(f"a proper {name} was answered with PDUs {kinds}, {content[-64:]}")
                if resident_mb(listener) > LARGEST_MB:
                    failed(f"the listener takes {resident_mb(listener):.0f} MB")
        listener.stdin.close()
        try:
            if listener.wait(60) != 0:
                failed(f"the listener ended with {listener.returncode}")
        except subprocess.TimeoutExpired:
            failed("the listener did not end")
    print(f"{exchanges} exchanges, no finding")


main()
