#!/bin/sh -e
# build.sh SOURCE PROGRAM FLAG...: what clang's CUDA mode makes of a source. PROGRAM.ptx is the device's half in NVIDIA's
# assembly; PROGRAM runs on this machine, its device's half from the same intermediate code, compiled for this processor.
source=$1 program=$2 here=$(dirname "$0")
shift 2
cuda() {
  clang++ -std=c++17 -x cuda -nocudainc -nocudalib --cuda-gpu-arch=sm_70 -Wno-unknown-cuda-version -O2 -ffp-contract=off \
    -Wall -Wextra -Wpedantic -Werror -I "$here" "$@"
}
cuda --cuda-device-only -S -emit-llvm -o "$program.device.ll" "$source" "$@"
clang++ --target=nvptx64-nvidia-cuda -march=sm_70 -nocudalib -Wno-unknown-cuda-version -O2 -S -o "$program.ptx" "$program.device.ll"
cuda --cuda-host-only -c -o "$program.host.o" "$source" "$@"
# The kernel takes its work by address, the thread's place from runtime.cpp; no function is merged with one of the host.
sed -E -e '/^target |^!nvvm|^\$/d' \
  -e 's/@_ZN8jourdain6detail12work_on_each[A-Za-z0-9_]*/@kernel/; s/byval\([^)]*\)//' \
  -e 's/@llvm.nvvm.read.ptx.sreg.ctaid.x/@device_block_index/; s/@llvm.nvvm.read.ptx.sreg.ntid.x/@device_threads/' \
  -e 's/@llvm.nvvm.read.ptx.sreg.tid.x/@device_thread_index/' \
  -e 's/ *"target-(cpu|features)"="[^"]*"//g; s/,? comdat(,| |$)/\1/; s/linkonce_odr (dso_local )?/internal /' \
  "$program.device.ll" >"$program.ll"
clang++ -O1 -Wno-override-module -c -o "$program.device.o" "$program.ll"
clang++ -std=c++17 -O1 -Wall -Wextra -Wpedantic -Werror -o "$program" "$program.host.o" "$program.device.o" "$here/runtime.cpp"
