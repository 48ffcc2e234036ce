#include "served_program.h"

#include "fields/patience.h"
#include "raw_client.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <poll.h>
#include <stdexcept>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace voxsheet::http_test {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

std::string Answer::field(const char* name) const { return fieldOfResponse(text, name).value_or(""); }

std::string sampleNrrd(int offset) {
    std::string file = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 12 10 8\nencoding: raw\n\n";
    for (int z = 0; z < 8; ++z)
        for (int y = 0; y < 10; ++y)
            for (int x = 0; x < 12; ++x)
                file.push_back(static_cast<char>(x + 10 * y + 3 * z + offset));
    return file;
}

ServedProgram::ServedProgram(int files, const std::vector<std::string>& moreArguments) {
    std::string name = (fs::temp_directory_path() / "voxsheet_http_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    base_ = fs::canonical(name);
    folder_ = base_ / "data";
    fs::create_directories(folder_);
    std::vector<std::string> arguments{"serve",          "--port", "0",       "--token",       token_,
                                       "--root",         folder_,  "--store", base_ / "store", "--upload-dir",
                                       base_ / "uploads"};
    arguments.insert(arguments.end(), moreArguments.begin(), moreArguments.end());
    for (int i = 0; i < files; ++i) {
        const auto file = folder_ / (std::string(1, static_cast<char>('a' + i)) + ".nrrd");
        std::ofstream(file, std::ios::binary) << sampleNrrd(i);
        arguments.push_back(file);
    }
    start(arguments);
}

void ServedProgram::start(const std::vector<std::string>& arguments) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    const std::string program = VOXSHEET_BINARY_DIR "/voxsheet";
    pid_ = ::fork();
    if (pid_ == 0) {
        ::dup2(ends[1], STDOUT_FILENO);
        std::vector<char*> list{const_cast<char*>(program.c_str())};
        for (const auto& argument : arguments)
            list.push_back(const_cast<char*>(argument.c_str()));
        list.push_back(nullptr);
        ::execv(program.c_str(), list.data());
        ::_exit(127);
    }
    ::close(ends[1]);
    output_ = ends[0];
    std::string line;
    const auto until = Clock::now() + std::chrono::seconds(60);
    while (line.find('\n') == std::string::npos && Clock::now() < until) {
        pollfd entry{output_, POLLIN, 0};
        if (::poll(&entry, 1, 200) <= 0) continue;
        char c = 0;
        if (::read(output_, &c, 1) != 1) break;
        line.push_back(c);
    }
    const auto colon = line.rfind(':');
    if (!line.starts_with("ready http://") || colon == std::string::npos)
        throw std::runtime_error("the program did not become ready: " + line);
    port_ = std::stoi(line.substr(colon + 1));
}

ServedProgram::~ServedProgram() {
    if (pid_ > 0) stop(SIGKILL, 5.0);
    if (output_ >= 0) ::close(output_);
    std::error_code ignored;
    fs::remove_all(base_, ignored);
}

int ServedProgram::stop(int signal, double seconds) {
    ::kill(pid_, signal);
    const auto until = Clock::now() + std::chrono::duration<double>(seconds * fields::patience());
    int status = 0;
    while (::waitpid(pid_, &status, WNOHANG) == 0) {
        if (Clock::now() > until) return -1;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

Answer ServedProgram::askBare(const std::string& method, const std::string& target, const std::string& fields,
                              const std::string& body) const {
    std::string request = method + " " + target + " HTTP/1.1\r\nConnection: close\r\n" + fields;
    if (!body.empty()) request += "Content-Length: " + std::to_string(body.size()) + "\r\n";
    Answer answer;
    answer.text = exchange(port_, request + "\r\n" + body, 30.0);
    answer.status = statusOfResponse(answer.text);
    answer.body = bodyOfResponse(answer.text);
    return answer;
}

Answer ServedProgram::ask(const std::string& method, const std::string& target, const std::string& body,
                          const std::string& fields) const {
    return askBare(method, target, "Host: localhost\r\nAuthorization: Bearer " + token_ + "\r\n" + fields,
                   body);
}

bool ServedProgram::waitForImports() const {
    const auto until = Clock::now() + std::chrono::seconds(60);
    while (Clock::now() < until) {
        const auto answer = get("/api/v1/datasets");
        bool busy = answer.status != 200; // overloaded: to be asked again
        const auto list = busy ? nlohmann::json::array() : answer.json().at("datasets");
        for (const auto& dataset : list)
            busy = busy || (dataset.at("state") != "ready" && dataset.at("state") != "failed");
        if (!busy) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
}

} // namespace voxsheet::http_test
