#include "confinement.h"

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <vector>

#include "helper_protocol.h"

// GCC and clang tell of it in ways of their own.
#if defined(__SANITIZE_ADDRESS__)
#define VICON_ADDRESS_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define VICON_ADDRESS_SANITIZER
#endif
#endif

namespace vicon::ingest {
namespace {

/// The largest frame that import takes (8192 x 8192) needs 600 MB in OpenJPEG.
[[maybe_unused]] constexpr rlim_t kMemoryBytes = rlim_t(1) << 30;
/// Standard streams, and one file that is handed over at a time.
constexpr rlim_t kDescriptors = 8;
/// Less than a thread of VICON has: what is read here on this stack is read there as well.
constexpr rlim_t kStackBytes = rlim_t(1) << 20;

/// Memory, the given descriptors, time, signals, the end: nothing that names a file, a peer or a process.
constexpr std::array kAllowed{
    __NR_read,         __NR_write,          __NR_readv,        __NR_writev,      __NR_recvmsg,     __NR_recvfrom,
    __NR_sendto,       __NR_sendmsg,        __NR_close,        __NR_lseek,       __NR_pread64,     __NR_mmap,
    __NR_munmap,       __NR_mremap,         __NR_mprotect,     __NR_madvise,     __NR_brk,         __NR_futex,
    __NR_rt_sigaction, __NR_rt_sigprocmask, __NR_rt_sigreturn, __NR_sigaltstack, __NR_setitimer,   __NR_clock_gettime,
    __NR_gettimeofday, __NR_getpid,         __NR_gettid,       __NR_getrandom,   __NR_sched_yield, __NR_restart_syscall,
    __NR_exit,         __NR_exit_group};

#if defined(__x86_64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
#else
#error "name this machine's system call architecture"
#endif

/// What cannot be taken away ends this process: nothing is decoded in the open.
void require(bool done)
{
    if (!done)
        ::_exit(kNotConfined);
}

void filterSystemCalls()
{
    std::vector<sock_filter> program{
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, arch)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kArchitecture, 1, 0),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS),
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
    };
    for (std::size_t n = 0; n < kAllowed.size(); ++n)
        program.push_back(
            BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, std::uint32_t(kAllowed[n]), std::uint8_t(kAllowed.size() - n), 0));
    program.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM));
    program.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
    const sock_fprog filter{static_cast<unsigned short>(program.size()), program.data()};
    require(::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0);
    require(::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) == 0);
}

/// Whoever started this program may have left it less.
void limit(__rlimit_resource resource, rlim_t most)
{
    rlimit now{};
    require(::getrlimit(resource, &now) == 0);
    const rlim_t least = std::min(most, now.rlim_max);
    const rlimit both{least, least};
    require(::setrlimit(resource, &both) == 0);
}

}  // namespace

void confine()
{
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT})  // meant for VICON, which ends this process itself
        ::signal(signal, SIG_IGN);
    require(::prctl(PR_SET_DUMPABLE, 0) == 0);  // no core file: it would hold a patient's data
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_FSIZE, 0);
    limit(RLIMIT_STACK, kStackBytes);
    limit(RLIMIT_NOFILE, kDescriptors);
#ifndef VICON_ADDRESS_SANITIZER  // which reserves terabytes of addresses
    limit(RLIMIT_AS, kMemoryBytes);
#endif
    filterSystemCalls();
}

void limitProcessorTime(std::uint32_t seconds)
{
    const itimerval timer{{0, 0}, {time_t(seconds), 0}};
    ::setitimer(ITIMER_PROF, &timer, nullptr);  // its signal ends the process
}

}  // namespace vicon::ingest
