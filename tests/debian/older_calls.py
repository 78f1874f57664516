#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""older_calls.py COMMAND...: runs the command on x86-64 like on a Linux of 2014. Debian's PRoot does not know system calls of
later Linux versions, and would not change the paths in them. If the system lacks a call, the C library uses an older call."""

import ctypes
import errno
import os
import struct
import sys

LATER_CALLS = {"statx": 332, "clone3": 435, "openat2": 437, "faccessat2": 439, "fchmodat2": 452}

# The filter is a program of struct sock_filter. Each struct has a code, the jumps for true and for false, and a value.
LOAD_CALL, JUMP_IF_EQUAL, RETURN = 0x20, 0x15, 0x06
ALLOW, FAIL = 0x7FFF0000, 0x00050000
PR_SET_SECCOMP, PR_SET_NO_NEW_PRIVS, SECCOMP_MODE_FILTER = 22, 38, 2


def leave_out(calls):
    program = [(LOAD_CALL, 0, 0, 0)]
    program += [(JUMP_IF_EQUAL, len(calls) - i, 0, number) for i, number in enumerate(calls)]
    program += [(RETURN, 0, 0, ALLOW), (RETURN, 0, 0, FAIL | errno.ENOSYS)]
    code = ctypes.create_string_buffer(b"".join(struct.pack("HBBI", *line) for line in program))
    head = ctypes.create_string_buffer(struct.pack("HP", len(program), ctypes.addressof(code)))
    libc = ctypes.CDLL(None, use_errno=True)
    for arguments in (PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0), (PR_SET_SECCOMP, SECCOMP_MODE_FILTER, head, 0, 0):
        if libc.prctl(*arguments) != 0:
            sys.exit(f"older_calls.py: the system sets no filter of calls: {os.strerror(ctypes.get_errno())}")


if __name__ == "__main__":
    leave_out(LATER_CALLS.values())
    os.execvp(sys.argv[1], sys.argv[1:])
