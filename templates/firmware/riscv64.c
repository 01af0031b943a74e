/* Start of a firmware for qemu's RISC-V board "virt" with an rv64gc, in machine mode. */
#include "board.h"

/* Of the linker script. */
extern uint64_t bss_start[], bss_end[];
extern void (*const constructors_start[])(void), (*const constructors_end[])(void);

int main(void);

/* A call of the debugger: what and its argument ("RISC-V Semihosting"); the two instructions around ebreak mark it. They
   must lie in one page. */
static long semihosting(long call, const void *argument) {
  register long a0 __asm__("a0") = call;
  register const void *a1 __asm__("a1") = argument;
  __asm__ volatile(
      ".balign 16\n\t.option push\n\t.option norvc\n\t"
      "slli zero, zero, 0x1f\n\tebreak\n\tsrai zero, zero, 7\n\t.option pop"
      : "+r"(a0)
      : "r"(a1)
      : "memory");
  return a0;
}

enum { sys_write0 = 0x04, sys_exit_extended = 0x20, application_exit = 0x20026 };

void board_write(const char *text) { (void)semihosting(sys_write0, text); }

void board_exit(int status) {
  const uint64_t reason[2] = {application_exit, (uint64_t)status};
  for (;;) (void)semihosting(sys_exit_extended, reason);
}

const unsigned board_instructions_unit = 1;

uint64_t board_instructions(void) {
  uint64_t count;
  __asm__ volatile("csrr %0, minstret" : "=r"(count));
  return count;
}

__attribute__((used)) void board_fault(void) {
  board_write("the firmware has made a fault\n");
  board_exit(board_status_fault);
}

__attribute__((used, optimize("no-tree-loop-distribute-patterns"))) void board_start(void) {
  uint64_t *word;
  void (*const *constructor)(void);
  for (word = bss_start; word < bss_end; ++word) *word = 0;
  board_paint_stack(board_stack_pointer());
  for (constructor = constructors_start; constructor < constructors_end; ++constructor) (*constructor)();
  board_end(main());
}

/* mstatus.FS = 1 switches the floating-point unit on; tp points at what is thread-local, which is errno. A fault may be that
   of a stack that has grown too deep, so it begins anew. */
__asm__(
    ".section .start, \"ax\"\n"
    ".globl board_reset\n"
    "board_reset:\n"
    ".option push\n.option norelax\n"
    "  la gp, __global_pointer$\n"
    ".option pop\n"
    "  la sp, board_stack_top\n"
    "  la tp, thread_start\n"
    "  la t0, board_trap\n"
    "  csrw mtvec, t0\n"
    "  li t0, 0x2000\n"
    "  csrs mstatus, t0\n"
    "  csrw fcsr, zero\n"
    "  j board_start\n"
    ".balign 4\n"
    "board_trap:\n"
    "  la sp, board_stack_top\n"
    "  j board_fault\n"
    ".text\n");
