#include "engine/config_files.h"

#include "base/embedded.h"
#include "base/errors.h"

#include <string>

namespace voxsheet {
extern const EmbeddedFile configFiles[];
extern const std::size_t configFilesCount;
} // namespace voxsheet

namespace voxsheet::engine {

std::string_view configFile(std::string_view name) {
    for (std::size_t i = 0; i < configFilesCount; ++i)
        if (std::string_view(configFiles[i].path) == name) return configFiles[i].bytes();
    throw InternalError("the file " + std::string(name), "it was not built into this program",
                        "build it again");
}

} // namespace voxsheet::engine
