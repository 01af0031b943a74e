/* Included at the end of a block, which it runs: block STEPS STEP [PARAMETER...], STEP a number or [], inputs 0.1, 0.2, …
   held. Prints what the ports hold at the end, a line for each, or the block's error with status 3. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int main(int count, char** words) {
  double step = atof(words[2]), numbers[64], input[64];
  mxArray parameters[2];
  SimStruct block = {0};
  int k, i;

  for (k = 0; k < 64; ++k) input[k] = 0.1 * (k + 1);
  for (k = 3; k < count; ++k) numbers[k - 3] = atof(words[k]);
  parameters[0].count = strcmp(words[2], "[]") != 0;
  parameters[0].numbers = parameters[0].count > 0 ? &step : NULL;
  parameters[1].numbers = numbers;
  parameters[1].count = (size_t)(count - 3);
  block.parameters = parameters;
  block.parameter_count = 2;
  mdlInitializeSizes(&block);
  if (block.input_width > 64 || block.work_type != SS_UINT8 || block.work_vectors != 1 ||
      block.sample_times != 1)
    return 1;
  if (block.input_ports > 0 && !block.contiguous) return 1;
  block.input = input;
  for (k = 0; k < block.output_ports; ++k)
    block.outputs[k] = (double*)calloc((size_t)block.output_widths[k], sizeof(double));
  block.work = (char*)malloc((size_t)block.work_width + 1) + 1; /* wherever it lies */
  mdlInitializeSampleTimes(&block);
  if (!block.error) mdlStart(&block);
  for (k = 0; k <= atoi(words[1]) && !block.error; ++k) {
    mdlOutputs(&block, 0);
    if (k < atoi(words[1]) && !block.error) mdlUpdate(&block, 0);
  }
  mdlTerminate(&block);
  if (block.error) puts(block.error);
  for (k = 0; k < block.output_ports; ++k) {
    for (i = 0; i < block.output_widths[k] && !block.error; ++i) printf("%.17g ", block.outputs[k][i]);
    if (!block.error) puts("");
    free(block.outputs[k]);
  }
  free((char*)block.work - 1);
  return block.error ? 3 : 0;
}
