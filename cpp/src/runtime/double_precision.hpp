// Rejects a compiler whose doubles are not IEEE doubles. On 32-bit x86 without SSE2, values are
// kept with 64 bits and rounded twice, so bitwise identical results are impossible. Nothing is
// included here, so that a compiler can be tested without the headers of its target.
#pragma once

#if defined(__FLT_EVAL_METHOD__) && (__FLT_EVAL_METHOD__ == 2 || __FLT_EVAL_METHOD__ < 0)
#error "curvewise needs arithmetic in double precision; compile with -msse2 -mfpmath=sse"
#elif defined(_M_IX86_FP) && _M_IX86_FP < 2
#error "curvewise needs arithmetic in double precision; compile with /arch:SSE2"
#endif
