// The host/device macro: the one file that asks which compiler reads it.
#pragma once

#ifdef __CUDACC__
#define GEM_HD __host__ __device__
#else
#define GEM_HD
#endif
