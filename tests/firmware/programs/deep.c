/* Writes more of the stack than there is. */
#include "board.h"

__attribute__((noinline)) static unsigned fill(unsigned seed) {
  volatile unsigned char bytes[0x120000];
  unsigned i;
  for (i = 0; i < sizeof bytes; i += 4) bytes[i] = (unsigned char)(seed + i);
  return bytes[sizeof bytes - 4];
}

int main(void) { return fill(7) == 0; }
