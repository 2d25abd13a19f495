// Host, device and inlining macros: the only file that asks which compiler reads it. GEM_DEVICE marks code that a CUDA
// compiler builds for the device only.
#pragma once

#ifdef __CUDACC__
#define GEM_HD __host__ __device__
#define GEM_DEVICE __device__
#define GEM_INLINE __forceinline__
#define GEM_NOINLINE __noinline__
#define GEM_NO_UNROLL _Pragma("unroll 1")
#else
#define GEM_HD
#define GEM_DEVICE
#define GEM_INLINE inline __attribute__((always_inline))
#define GEM_NOINLINE __attribute__((noinline))
#define GEM_NO_UNROLL
// GEM_CLONES: a host function is also built for AVX2. The bits are the same, since no fused multiply-add is used. Not
// with the thread sanitizer: the function is selected at program start, before the sanitizer is ready.
#ifdef __SANITIZE_THREAD__
#define GEM_CLONES
#else
#define GEM_CLONES __attribute__((target_clones("avx2", "default")))
#endif
// GEM_WIDE: a host function is built for AVX-512. It is called only where has_wide_packs() says so (pack.h).
#define GEM_WIDE __attribute__((target("avx512f")))
#endif
