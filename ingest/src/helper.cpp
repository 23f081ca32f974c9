#include "helper.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <mutex>

#include "helper_process.h"
#include "structure_scan.h"
#include "vicon/core/error.h"

namespace vicon::ingest {
namespace {

/// A second try tells a file that ends the program from a program that was ended for another reason.
constexpr int kTries = 2;
constexpr std::uint32_t kReadingSeconds = 2;

/// Programs that wait for work. One thread uses one at a time.
class Pool {
public:
    std::unique_ptr<HelperProcess> take()
    {
        {
            const std::lock_guard lock(mutex_);
            if (!idle_.empty()) {
                auto helper = std::move(idle_.back());
                idle_.pop_back();
                return helper;
            }
        }
        return std::make_unique<HelperProcess>();
    }
    void giveBack(std::unique_ptr<HelperProcess> helper)
    {
        const std::lock_guard lock(mutex_);
        idle_.push_back(std::move(helper));
    }
    void endIdle()
    {
        std::vector<std::unique_ptr<HelperProcess>> ended;
        const std::lock_guard lock(mutex_);
        ended.swap(idle_);
    }

private:
    std::mutex mutex_;
    std::vector<std::unique_ptr<HelperProcess>> idle_;
};

Pool& pool()
{
    static Pool the_pool;
    return the_pool;
}

/// Asks a program; one that ends is replaced, and the question put once more. Throws HelperDied, Error.
std::vector<char> ask(const HelperRequest& request, std::string_view payload, int descriptor, std::size_t most_bytes)
{
    for (int attempt = 1;; ++attempt) {
        auto helper = attempt == 1 ? pool().take() : std::make_unique<HelperProcess>();
        try {
            std::vector<char> bytes = helper->ask(request, payload, descriptor, most_bytes);
            pool().giveBack(std::move(helper));
            return bytes;
        } catch (const Error& e) {
            if (e.code() == ErrorCode::bad_input)
                pool().giveBack(std::move(helper));
            throw;
        } catch (const HelperDied& e) {
            if (attempt == kTries || e.too_slow)
                throw;
        }
    }
}

struct Descriptor {
    int number;
    ~Descriptor()
    {
        if (number >= 0)
            ::close(number);
    }
};

}  // namespace

std::vector<char> decodeInHelper(std::string_view stream, const PixelFormat& format, const std::string& transfer_syntax)
{
    if (stream.size() > kLargestStream)
        throw Error(ErrorCode::bad_input, "its compressed pixels are larger than any image");
    const std::size_t needed =
        std::size_t(format.columns) * std::size_t(format.rows) * std::size_t(format.bits_allocated / 8);
    try {
        std::vector<char> pixels = ask(decodeRequest(format, transfer_syntax, stream.size()), stream, -1, needed);
        if (pixels.size() != needed)
            throw Error(ErrorCode::bad_input, "its compressed pixels make a smaller image than its header says");
        return pixels;
    } catch (const HelperDied& e) {
        throw Error(ErrorCode::bad_input,
                    "its compressed pixels cannot be decoded safely (the decoder " + std::string(e.what()) + ")");
    }
}

std::string whyHarmful(const std::filesystem::path& file)
{
    const Descriptor descriptor{::open(file.c_str(), O_RDONLY | O_CLOEXEC)};
    if (descriptor.number < 0)
        return "cannot be read (" + std::string(std::strerror(errno)) + ")";
    HelperRequest request;
    request.kind = HelperRequest::Kind::read;
    request.cpu_seconds = kReadingSeconds;
    try {
        ask(request, {}, descriptor.number, 0);
    } catch (const HelperDied& e) {
        return "damaged, or made to harm: its elements cannot be read safely (the reader " + std::string(e.what()) +
               ")";
    } catch (const Error& e) {
        if (e.code() != ErrorCode::bad_input)
            throw;
        return "damaged: its elements cannot be read (" + std::string(e.what()) + ")";
    }
    return {};
}

std::string whyNotToRead(const std::filesystem::path& file)
{
    const Structure structure = scanStructure(file);
    if (structure.fate == Structure::Fate::odd)
        return whyHarmful(file);
    return structure.why;
}

void endIdleHelpers()
{
    pool().endIdle();
}

}  // namespace vicon::ingest
