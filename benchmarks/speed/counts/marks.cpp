// The marks that callgrind sees, for a program in Python (calls.py).
#include <valgrind/callgrind.h>

extern "C" void counts_begin() {
    CALLGRIND_START_INSTRUMENTATION;
    CALLGRIND_ZERO_STATS;
}

extern "C" void counts_end(const char* name) { CALLGRIND_DUMP_STATS_AT(name); }
