/* What a firmware needs of its board: text out, an end, a count of instructions, a stack that can be painted.
   Boards: cortex_m.c (qemu's mps2-an386 and mps2-an500), riscv64.c (qemu's virt). */
#ifndef BOARD_H
#define BOARD_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Sends text to whoever debugs the board: semihosting. */
void board_write(const char* text);

static inline void board_write_number(int64_t number) {
  char text[24], *first = text + sizeof text;
  uint64_t rest = number < 0 ? -(uint64_t)number : (uint64_t)number;
  *--first = '\0';
  do *--first = (char)('0' + rest % 10);
  while ((rest /= 10) != 0);
  if (number < 0) *--first = '-';
  board_write(first);
}

/* Ends the program; the simulator exits with this status. Does not return. */
void board_exit(int status);

/* With what a program ends that has made a fault, or has written below its stack. */
enum { board_status_fault = 120, board_status_stack = 121 };

/* Instructions executed since the start. They are counted by qemu's virtual time, so start it with `-icount shift=0`;
   without, the number means nothing. */
uint64_t board_instructions(void);

/* What board_instructions() counts in: it is a multiple of this. */
extern const unsigned board_instructions_unit;

/* Of the linker script: lowest and first word beyond the highest of the stack. */
extern uint32_t board_stack_limit[];
extern uint32_t board_stack_top[];

enum { board_paint = 0x5AFEC0DE };

static inline uint32_t* board_stack_pointer(void) {
  uint32_t* pointer;
#if defined(__riscv)
  __asm__ volatile("mv %0, sp" : "=r"(pointer));
#else
  __asm__ volatile("mov %0, sp" : "=r"(pointer));
#endif
  return pointer;
}

/* Paints the stack below `top`, which must not lie above the stack pointer. */
static inline __attribute__((always_inline)) void board_paint_stack(uint32_t* top) {
  volatile uint32_t* word;
  for (word = board_stack_limit; word < top; ++word) *word = board_paint;
}

/* Bytes below `top` down to the deepest word that has been written since it was painted. */
static inline uint32_t board_stack_used(const uint32_t* top) {
  const volatile uint32_t* word = board_stack_limit;
  while (word < top && *word == board_paint) ++word;
  return (uint32_t)((uintptr_t)top - (uintptr_t)word);
}

/* The end of a program whose main returned: nothing it says holds where its stack has grown over the lowest word. */
static inline void board_end(int status) {
  if (*board_stack_limit != board_paint) {
    board_write("the stack is too short\n");
    status = board_status_stack;
  }
  board_exit(status);
}

#ifdef __cplusplus
}
#endif

#endif
