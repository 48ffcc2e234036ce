// The first program of a bundle (`./run --bundle`): BUNDLE/bin/NAME, which starts BUNDLE/bin/NAME.elf by the
// bundle's own dynamic loader with the bundle's own libraries. Linked statically: it needs nothing of the
// machine that it runs on, no shell either. Variables that the user has set stay as they are.
#include <dirent.h>
#include <unistd.h>

#include <climits>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

/// Empty when /proc is not there.
std::string ownPath() {
    std::vector<char> text(PATH_MAX);
    const auto length = readlink("/proc/self/exe", text.data(), text.size());
    return length > 0 ? std::string(text.data(), static_cast<std::size_t>(length)) : std::string();
}

std::string parentOf(const std::string& path) { return path.substr(0, path.rfind('/')); }

/// Vendors of this machine, such as a GPU's, go first; Mesa is the bundle's own, which fits its libraries.
std::string eglVendors(const std::string& bundle) {
    std::string files;
    for (const char* folder : {"/etc/glvnd/egl_vendor.d", "/usr/share/glvnd/egl_vendor.d"}) {
        DIR* entries = opendir(folder);
        if (entries == nullptr) continue;
        while (const dirent* entry = readdir(entries)) {
            const std::string name = entry->d_name;
            if (name.ends_with(".json") && name.find("mesa") == std::string::npos)
                files += std::string(folder) + "/" + name + ":";
        }
        closedir(entries);
    }
    return files + bundle + "/share/glvnd/egl_vendor.d/50_mesa.json";
}

} // namespace

int main(int argc, char** argv) {
    const auto self = ownPath();
    if (self.empty()) {
        std::fprintf(stderr, "voxsheet: error: this bundle: it does not find itself; mount /proc\n");
        return 1;
    }
    const auto bundle = parentOf(parentOf(self));
    setenv("__EGL_VENDOR_LIBRARY_FILENAMES", eglVendors(bundle).c_str(), 0);
    setenv("LIBGL_DRIVERS_PATH", (bundle + "/lib/dri").c_str(), 0);
    std::vector<std::string> arguments{bundle + "/lib/ld.so",     "--library-path",
                                       bundle + "/lib",           "--argv0",
                                       argc > 0 ? argv[0] : self, self + ".elf"};
    for (int i = 1; i < argc; ++i)
        arguments.emplace_back(argv[i]);
    std::vector<char*> list;
    for (auto& argument : arguments)
        list.push_back(argument.data());
    list.push_back(nullptr);
    execv(list.front(), list.data());
    std::perror(("voxsheet: error: " + arguments.front()).c_str());
    return 1;
}
