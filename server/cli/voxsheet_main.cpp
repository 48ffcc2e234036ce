#include "cli/commands.h"

int main(int argc, char** argv) { return voxsheet::cli::runProgram(argc, argv); }
