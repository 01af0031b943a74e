// The part of CUDA's runtime that ensembles call, on this machine: clang's CUDA mode cuts a source in two, and here the
// device's half, compiled for this processor, is called once for each thread of a launch.
#pragma once

#define __host__ __attribute__((host))
#define __device__ __attribute__((device))
#define __global__ __attribute__((global))

#include <math.h>
#include <stddef.h>
#include <string.h>

// The device's own functions stand beside those of the C library.
#define JOURDAIN_ONE(name)                   \
  extern "C" __device__ double name(double); \
  extern "C" __device__ float name##f(float)
#define JOURDAIN_TWO(name)                           \
  extern "C" __device__ double name(double, double); \
  extern "C" __device__ float name##f(float, float)
JOURDAIN_ONE(sqrt);
JOURDAIN_ONE(fabs);
JOURDAIN_ONE(floor);
JOURDAIN_ONE(sin);
JOURDAIN_ONE(cos);
JOURDAIN_ONE(tan);
JOURDAIN_ONE(asin);
JOURDAIN_ONE(acos);
JOURDAIN_ONE(atan);
JOURDAIN_ONE(sinh);
JOURDAIN_ONE(cosh);
JOURDAIN_ONE(tanh);
JOURDAIN_ONE(exp);
JOURDAIN_ONE(log);
JOURDAIN_TWO(atan2);
JOURDAIN_TWO(pow);
JOURDAIN_TWO(copysign);
#undef JOURDAIN_ONE
#undef JOURDAIN_TWO

struct uint3 {
  unsigned x, y, z;
};
struct dim3 {
  unsigned x, y, z;
  __host__ __device__ constexpr dim3(unsigned x_ = 1, unsigned y_ = 1, unsigned z_ = 1)
      : x(x_), y(y_), z(z_) {}
};
#include <__clang_cuda_builtin_vars.h>

typedef int cudaError_t;
typedef struct CUstream_st* cudaStream_t;
enum { cudaSuccess, cudaMemcpyHostToDevice, cudaMemcpyDeviceToHost };

extern "C" {
cudaError_t cudaMalloc(void** memory, size_t bytes);
cudaError_t cudaFree(void* memory);
cudaError_t cudaMemcpy(void* to, const void* from, size_t bytes, int kind);
cudaError_t cudaGetLastError();
cudaError_t cudaDeviceSynchronize();
const char* cudaGetErrorString(cudaError_t error);
cudaError_t cudaLaunchKernel(const void*, dim3 grid, dim3 block, void** arguments, size_t, cudaStream_t);
cudaError_t cudaConfigureCall(dim3 grid, dim3 block, size_t = 0,
                              cudaStream_t = nullptr);  // of the device's half, which launches nothing
unsigned __cudaPushCallConfiguration(dim3 grid, dim3 block, size_t = 0, cudaStream_t = nullptr);
cudaError_t __cudaPopCallConfiguration(dim3* grid, dim3* block, size_t* memory, void* stream);
}
