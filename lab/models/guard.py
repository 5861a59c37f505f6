"""Calls a function in a process of its own: a crash, a hang or a large demand of an outside program ends that process alone."""

import multiprocessing
import os
import resource
import signal

# What another program may ask for [bytes]: a mesh that is out of hand ends here.
MEMORY = 8 << 30

FORK = multiprocessing.get_context("fork")


def child(pipe, function, arguments):
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    null = os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, 1)
    os.dup2(null, 2)
    try:
        pipe.send((True, function(*arguments)))
    except BaseException as fault:  # each program has its own
        lines = str(fault).strip().splitlines()
        pipe.send((False, f"{type(fault).__name__}: {lines[0][:200] if lines else ''}"))
    pipe.close()
    os._exit(0)


def call(function, arguments, seconds):
    """(True, result), or (False, why there is none)."""
    ours, theirs = FORK.Pipe(duplex=False)
    process = FORK.Process(target=child, args=(theirs, function, arguments))
    process.start()
    theirs.close()
    try:
        if not ours.poll(seconds):
            return False, f"longer than {seconds:g} s"
        return ours.recv()
    except EOFError:
        process.join(5)
        code = process.exitcode or 0
        return False, f"ended by {signal.Signals(-code).name}" if code < 0 else f"ended with {code}"
    finally:
        process.kill()
        process.join()
        ours.close()
