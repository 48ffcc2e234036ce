#include "base/thread_count.h"

#include "base/control_group.h"
#include "base/host_memory.h"

#include <gtest/gtest.h>

#include <sched.h>
#include <unistd.h>

#include <fstream>
#include <future>
#include <map>
#include <thread>

namespace voxsheet {
namespace {

namespace fs = std::filesystem;

/// A system of our own: /proc/self and /sys/fs/cgroup below a temporary folder, and an environment.
class InventedSystem {
public:
    InventedSystem() {
        auto name = (fs::temp_directory_path() / "voxsheet_system_XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
        root_ = name;
    }
    ~InventedSystem() {
        std::error_code ignored;
        fs::remove_all(root_, ignored);
    }
    InventedSystem(const InventedSystem&) = delete;
    InventedSystem& operator=(const InventedSystem&) = delete;

    void write(const std::string& file, const std::string& text) {
        fs::create_directories((root_ / file).parent_path());
        std::ofstream(root_ / file) << text;
    }
    void unified(const std::string& group, const std::string& mounted = "/") {
        write("proc/self/cgroup", "0::" + group + "\n");
        write("proc/self/mountinfo",
              "21 1 8:1 / / rw shared:1 - ext4 /dev/sda1 rw\n"
              "30 21 0:26 " +
                  mounted + " /sys/fs/cgroup rw,nosuid shared:4 master:1 - cgroup2 cgroup2 rw\n");
    }
    void set(const std::string& name, const std::string& value) { environment_[name] = value; }

    [[nodiscard]] ProcessView view() const {
        return {root_, [this](const char* name) -> const char* {
                    const auto found = environment_.find(name);
                    return found == environment_.end() ? nullptr : found->second.c_str();
                }};
    }
    [[nodiscard]] const fs::path& root() const { return root_; }

private:
    fs::path root_;
    std::map<std::string, std::string> environment_;
};

/// permittedThreads() where the affinity mask alone would give `processors`; -1 where this machine has fewer.
ThreadCount withProcessors(int processors, const ProcessView& view) {
    return std::async(std::launch::async,
                      [&] {
                          cpu_set_t all;
                          if (sched_getaffinity(0, sizeof all, &all) != 0) return ThreadCount{-1, "no mask"};
                          cpu_set_t some;
                          CPU_ZERO(&some);
                          for (std::size_t i = 0; i < CPU_SETSIZE && CPU_COUNT(&some) < processors; ++i)
                              if (CPU_ISSET(i, &all)) CPU_SET(i, &some);
                          if (CPU_COUNT(&some) < processors) return ThreadCount{-1, "too few processors"};
                          sched_setaffinity(0, sizeof some, &some); // of this thread alone
                          return permittedThreads(view);
                      })
        .get();
}

TEST(ThreadCount, IsTheAffinityMaskWhereNothingElseLimits) {
    const InventedSystem system;
    const auto one = withProcessors(1, system.view());
    EXPECT_EQ(one.threads, 1);
    EXPECT_EQ(one.reason, "1 processor in the affinity mask");
    const auto two = withProcessors(2, system.view());
    if (two.threads < 0) GTEST_SKIP() << "one processor only";
    EXPECT_EQ(two.threads, 2);
}

TEST(ThreadCount, ObeysTheQuotaOfVersion2) {
    InventedSystem system;
    system.unified("/user.slice/job");
    system.write("sys/fs/cgroup/user.slice/job/cpu.max", "50000 100000\n");
    const auto half = withProcessors(2, system.view());
    if (half.threads < 0) GTEST_SKIP() << "one processor only";
    EXPECT_EQ(half.threads, 1) << "half a processor is rounded up";
    EXPECT_EQ(half.reason, "the control group's quota of 0.5 processors");
    system.write("sys/fs/cgroup/user.slice/job/cpu.max", "110000 100000\n");
    EXPECT_EQ(withProcessors(2, system.view()).threads, 2) << "1.1 is rounded up";
    system.write("sys/fs/cgroup/user.slice/job/cpu.max", "max 100000\n");
    EXPECT_EQ(withProcessors(2, system.view()).threads, 2);
    system.write("sys/fs/cgroup/user.slice/cpu.max", "100000 100000\n");
    EXPECT_EQ(withProcessors(2, system.view()).threads, 1) << "the group above has a limit, too";
}

TEST(ThreadCount, ObeysTheQuotaOfVersion1) {
    InventedSystem system;
    system.write("proc/self/cgroup", "5:memory:/m\n4:cpu,cpuacct:/slurm/job_7\n0::/\n");
    system.write("proc/self/mountinfo",
                 "29 21 0:25 / /sys/fs/cgroup/cpuset rw - cgroup cgroup rw,cpuset\n"
                 "30 21 0:26 / /sys/fs/cgroup/cpu,cpuacct rw - cgroup cgroup rw,cpu,cpuacct\n");
    system.write("sys/fs/cgroup/cpu,cpuacct/slurm/job_7/cpu.cfs_quota_us", "-1\n");
    system.write("sys/fs/cgroup/cpu,cpuacct/slurm/job_7/cpu.cfs_period_us", "100000\n");
    const auto free = withProcessors(2, system.view());
    if (free.threads < 0) GTEST_SKIP() << "one processor only";
    EXPECT_EQ(free.threads, 2);
    system.write("sys/fs/cgroup/cpu,cpuacct/slurm/job_7/cpu.cfs_quota_us", "90000\n");
    EXPECT_EQ(withProcessors(2, system.view()).threads, 1);
}

TEST(ThreadCount, FindsAContainersGroupWhateverTheHostCallsIt) {
    InventedSystem system;
    system.unified("/docker/abc", "/docker/abc");
    system.write("sys/fs/cgroup/cpu.max", "100000 100000\n");
    const auto count = withProcessors(2, system.view());
    if (count.threads < 0) GTEST_SKIP() << "one processor only";
    EXPECT_EQ(count.threads, 1);
    system.unified("/docker/abc/inner", "/docker/abc");
    system.write("sys/fs/cgroup/inner/cpu.max", "max 100000\n");
    EXPECT_EQ(withProcessors(2, system.view()).threads, 1);
    system.unified("/../outside", "/");
    EXPECT_EQ(withProcessors(2, system.view()).threads, 1) << "what can not be seen is the mount itself";
}

TEST(ThreadCount, ObeysSlurm) {
    InventedSystem system;
    system.set("SLURM_CPUS_ON_NODE", "1");
    const auto node = withProcessors(2, system.view());
    if (node.threads < 0) GTEST_SKIP() << "one processor only";
    EXPECT_EQ(node.threads, 1);
    EXPECT_EQ(node.reason, "SLURM_CPUS_ON_NODE=1");
    system.set("SLURM_CPUS_PER_TASK", "2");
    EXPECT_EQ(withProcessors(2, system.view()).threads, 2) << "the task's share goes before the node's";
    for (const char* nonsense : {"", "0", "-3", "4(x2)", "many"}) {
        system.set("SLURM_CPUS_PER_TASK", nonsense);
        EXPECT_EQ(withProcessors(2, system.view()).threads, 1) << nonsense;
    }
    system.set("SLURM_CPUS_ON_NODE", "64");
    EXPECT_EQ(withProcessors(2, system.view()).threads, 2) << "never more than the mask";
}

TEST(ThreadCount, NobodyGetsMoreThanIsPermitted) {
    const ThreadCount permitted{4, "4 processors in the affinity mask"};
    EXPECT_EQ(chooseThreads(0, permitted).threads, 4);
    EXPECT_EQ(chooseThreads(3, permitted).threads, 3);
    EXPECT_EQ(chooseThreads(3, permitted).reason, "--threads 3");
    EXPECT_EQ(chooseThreads(64, permitted).threads, 4);
    EXPECT_EQ(chooseThreads(64, permitted).reason,
              "4 processors in the affinity mask; --threads 64 is more than that");
}

TEST(HostMemory, IsTheLowestLimitOfTheGroups) {
    InventedSystem system;
    const auto all = hostMemoryBytes(system.root());
    EXPECT_GT(all, 1U << 20U);
    system.unified("/job/step");
    system.write("sys/fs/cgroup/job/step/memory.max", "max\n");
    EXPECT_EQ(hostMemoryBytes(system.root()), all);
    system.write("sys/fs/cgroup/job/memory.max", "1048576\n");
    EXPECT_EQ(hostMemoryBytes(system.root()), 1U << 20U);
    system.write("proc/self/cgroup", "4:memory:/slurm\n");
    system.write("proc/self/mountinfo", "30 21 0:26 / /sys/fs/cgroup/memory rw - cgroup cgroup rw,memory\n");
    system.write("sys/fs/cgroup/memory/slurm/memory.limit_in_bytes", "524288\n");
    EXPECT_EQ(hostMemoryBytes(system.root()), 1U << 19U);
}

} // namespace
} // namespace voxsheet
