/* Reads where no memory is. */
#include "board.h"

int main(void) {
  const volatile uint32_t *volatile nowhere = (const volatile uint32_t *)0xF0000000u;
  return (int)*nowhere;
}
