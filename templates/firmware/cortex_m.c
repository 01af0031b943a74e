/* Start of a firmware for qemu's boards with an Arm Cortex-M4 (mps2-an386) or M7 (mps2-an500). */
#include "board.h"

typedef void (*handler)(void);

/* Of the linker script. */
extern uint32_t data_start[], data_end[], data_image[], bss_start[], bss_end[];
extern const handler constructors_start[], constructors_end[];

int main(void);

/* A call of the debugger: what and its argument (Arm: "Semihosting for AArch32 and AArch64"). */
static int32_t semihosting(int32_t call, const void *argument) {
  register int32_t r0 __asm__("r0") = call;
  register const void *r1 __asm__("r1") = argument;
  __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
  return r0;
}

enum { sys_write0 = 0x04, sys_exit_extended = 0x20, application_exit = 0x20026 };

void board_write(const char *text) { (void)semihosting(sys_write0, text); }

void board_exit(int status) {
  const uint32_t reason[2] = {application_exit, (uint32_t)status};
  for (;;) (void)semihosting(sys_exit_extended, reason);
}

/* A timer of the board counts down at 25 MHz; an instruction takes 1 ns of virtual time. It wraps after 171 s, which are
   1.7e11 instructions. */
typedef struct {
  volatile uint32_t control, value, reload;
} timer;
#define TIMER ((timer *)0x40000000u)
enum { timer_enable = 1 };
const unsigned board_instructions_unit = 40;

uint64_t board_instructions(void) { return (uint64_t)(UINT32_MAX - TIMER->value) * 40u; }

/* Coprocessors 10 and 11 are the floating-point unit (Armv7-M, CPACR). */
#define CPACR (*(volatile uint32_t *)0xE000ED88u)
enum { fpu_full_access = 0xF << 20 };

__attribute__((used)) void board_fault(void) {
  board_write("the firmware has made a fault\n");
  board_exit(board_status_fault);
}

/* The fault may be that of a stack that has grown too deep, so it begins anew. */
__attribute__((naked)) static void fault(void) {
  __asm__ volatile("ldr sp, =board_stack_top\n\tb board_fault");
}

/* No library is called before memory and the floating-point unit are ready, so this may be no loop that becomes memcpy. */
__attribute__((optimize("no-tree-loop-distribute-patterns"))) void board_start(void) {
  uint32_t *to = data_start;
  const uint32_t *from = data_image;
  const handler *constructor;
  CPACR |= fpu_full_access;
  __asm__ volatile("dsb\n\tisb" ::: "memory");
  while (to < data_end) *to++ = *from++;
  for (to = bss_start; to < bss_end; ++to) *to = 0;
  board_paint_stack(board_stack_pointer());
  TIMER->reload = UINT32_MAX;
  TIMER->value = UINT32_MAX;
  TIMER->control = timer_enable;
  for (constructor = constructors_start; constructor < constructors_end; ++constructor) (*constructor)();
  board_end(main());
}

/* The first two entries are the stack pointer and the start; the faults follow. There are no interrupts. */
__attribute__((section(".vectors"), used)) static const union {
  const uint32_t *stack;
  handler call;
} vectors[16] = {{board_stack_top}, {.call = board_start}, {.call = fault}, {.call = fault},
                 {.call = fault},   {.call = fault}, {.call = fault}};
