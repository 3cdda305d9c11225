#!/bin/sh
# Stands in for the emulator, to see what the tools make of it. PRETEND: hang, crash, fail, short, old, answer.
case "$*" in *--version*)
    case $PRETEND in old) echo "QEMU emulator version 6.1.0";; *) echo "QEMU emulator version 7.2.22";; esac
    exit 0;;
esac
case $PRETEND in
    hang) echo "row 0 0 1"; exec sleep 600;;
    crash) kill -SEGV $$;;
    fail) echo "fault: the processor took an exception"; exit 70;;
    short) echo "row 0 0 1"; exit 0;;
    answer) echo "row 0 0 1"; echo "end 1"; exit 0;;
esac
