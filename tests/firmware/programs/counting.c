/* What board.h counts, of work whose length is known: for 1000 and 3000 rounds the instructions of 1000 calls of a loop of
   two instructions, then the stack that a function with an array of 1000 bytes takes. */
#include "board.h"

static void write_number(uint64_t number) {
  board_write_number((int64_t)number);
  board_write("\n");
}

__attribute__((noinline)) static void loop(uintptr_t rounds) {
#if defined(__riscv)
  __asm__ volatile("1: addi %0, %0, -1\n\tbnez %0, 1b" : "+r"(rounds));
#else
  __asm__ volatile("1: subs %0, %0, #1\n\tbne 1b" : "+r"(rounds));
#endif
}

static uint64_t instructions_of(uintptr_t rounds) {
  const uint64_t before = board_instructions();
  int i;
  for (i = 0; i < 1000; ++i) loop(rounds);
  return board_instructions() - before;
}

__attribute__((noinline)) static unsigned fill(unsigned seed) {
  volatile unsigned char bytes[1000];
  unsigned i, sum = 0;
  for (i = 0; i < sizeof bytes; ++i) bytes[i] = (unsigned char)(seed + i);
  for (i = 0; i < sizeof bytes; ++i) sum += bytes[i];
  return sum;
}

int main(void) {
  uint32_t *const top = board_stack_pointer();
  unsigned sum;
  write_number(instructions_of(1000));
  write_number(instructions_of(3000));
  board_paint_stack(top);
  sum = fill(7);
  write_number(board_stack_used(top));
  return sum == 0;
}
