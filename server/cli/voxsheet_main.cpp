#include "base/heap.h"
#include "cli/commands.h"

int main(int argc, char** argv) {
    voxsheet::keepNoLargeBlocks();
    return voxsheet::cli::runProgram(argc, argv);
}
