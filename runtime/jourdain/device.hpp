// SPDX-License-Identifier: MIT
// Memory and launches of the device that a source is compiled for: by nvcc or clang's CUDA mode NVIDIA's, by hipcc
// AMD's. Any other compiler takes the host for it, which does one piece of the work after the other.
#pragma once

#include <string.h>

#include <cstddef>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#if defined(__HIP__) || defined(__HIPCC__)
#include <hip/hip_runtime.h>
#define JOURDAIN_DEVICE(name) hip##name
#elif defined(__CUDA__) || defined(__CUDACC__)
#include <cuda_runtime.h>
#define JOURDAIN_DEVICE(name) cuda##name
#endif

#if defined(JOURDAIN_DEVICE) && !defined(JOURDAIN_FUNCTION)
#define JOURDAIN_FUNCTION __host__ __device__
#elif !defined(JOURDAIN_FUNCTION)
#define JOURDAIN_FUNCTION
#endif

namespace jourdain {
namespace detail {

/// Within host or device; clang knows the built-in form on all devices.
JOURDAIN_FUNCTION inline void copy(void* to, const void* from, std::size_t bytes) {
#if defined(__clang__)
  __builtin_memcpy(to, from, bytes);
#else
  memcpy(to, from, bytes);
#endif
}

#if defined(JOURDAIN_DEVICE)

#define JOURDAIN_TEXT_OF(...) #__VA_ARGS__
#define JOURDAIN_TEXT(...) JOURDAIN_TEXT_OF(__VA_ARGS__)
static_assert(
    sizeof(JOURDAIN_TEXT(JOURDAIN_FUNCTION)) > 1,
    "include jourdain/device_ensemble.hpp before emitted headers: their functions are the host's alone");
#undef JOURDAIN_TEXT
#undef JOURDAIN_TEXT_OF

inline void check(JOURDAIN_DEVICE(Error_t) error) {
  if (error != JOURDAIN_DEVICE(Success)) throw std::runtime_error(JOURDAIN_DEVICE(GetErrorString)(error));
}

inline void* allocate_on_device(std::size_t bytes) {
  void* memory = nullptr;
  check(JOURDAIN_DEVICE(Malloc)(&memory, bytes));
  return memory;
}
inline void release_on_device(void* memory) noexcept { static_cast<void>(JOURDAIN_DEVICE(Free)(memory)); }
inline void copy_to_device(void* to, const void* from, std::size_t bytes) {
  check(JOURDAIN_DEVICE(Memcpy)(to, from, bytes, JOURDAIN_DEVICE(MemcpyHostToDevice)));
}
inline void copy_to_host(void* to, const void* from, std::size_t bytes) {
  check(JOURDAIN_DEVICE(Memcpy)(to, from, bytes, JOURDAIN_DEVICE(MemcpyDeviceToHost)));
}

template <class Work>
__global__ void work_on_each(Work work, std::size_t count) {
  const std::size_t k = static_cast<std::size_t>(blockIdx.x) * blockDim.x + threadIdx.x;
  if (k < count) work(k);
}
/// work(k) for each k below `count`, which is done when this returns.
template <class Work>
void run_on_device(const Work& work, std::size_t count) {
  const unsigned threads = 128;
  work_on_each<<<static_cast<unsigned>((count + threads - 1) / threads), threads>>>(work, count);
  check(JOURDAIN_DEVICE(GetLastError)());
  check(JOURDAIN_DEVICE(DeviceSynchronize)());
}

#else

inline void* allocate_on_device(std::size_t bytes) { return ::operator new(bytes); }
inline void release_on_device(void* memory) noexcept { ::operator delete(memory); }
inline void copy_to_device(void* to, const void* from, std::size_t bytes) {
  if (bytes > 0) memcpy(to, from, bytes);
}
inline void copy_to_host(void* to, const void* from, std::size_t bytes) { copy_to_device(to, from, bytes); }

template <class Work>
void run_on_device(const Work& work, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) work(k);
}

#endif

}  // namespace detail

/// `size` values that host and device both have, copied when one side asks for what the other has written.
template <class T>
class OnDevice {
 public:
  explicit OnDevice(std::size_t size, const T& value = T())
      : host_(size, value), device_(static_cast<T*>(detail::allocate_on_device((size + 1) * sizeof(T)))) {}

  /// To read on the host.
  const std::vector<T>& read() const {
    if (newest_ == Newest::kDevice) {
      detail::copy_to_host(host_.data(), device_.get(), host_.size() * sizeof(T));
      newest_ = Newest::kBoth;
    }
    return host_;
  }
  /// To read and write on the host.
  std::vector<T>& write() {
    read();
    newest_ = Newest::kHost;
    return host_;
  }
  /// To read on the device, by what `run` of an ensemble calls.
  const T* read_on_device() const {
    if (newest_ == Newest::kHost) {
      detail::copy_to_device(device_.get(), host_.data(), host_.size() * sizeof(T));
      newest_ = Newest::kBoth;
    }
    return device_.get();
  }
  /// To read and write there.
  T* write_on_device() {
    read_on_device();
    newest_ = Newest::kDevice;
    return device_.get();
  }

 private:
  enum class Newest { kHost, kDevice, kBoth };
  struct Release {
    void operator()(T* memory) const noexcept { detail::release_on_device(memory); }
  };

  mutable std::vector<T> host_;
  std::unique_ptr<T, Release> device_;
  mutable Newest newest_ = Newest::kHost;
};

}  // namespace jourdain
