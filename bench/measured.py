"""Processes with their seconds and peak memory."""
import os
import subprocess
import sys
import time


def run(command, folder):
    """Standard output, wall seconds and peak megabytes of a process; ends the bench when it fails."""
    begin = time.monotonic()
    process = subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, text=True)
    output = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"bench: {command[0]} failed")
    return output, time.monotonic() - begin, usage.ru_maxrss / 1e3
