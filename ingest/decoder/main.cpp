// The decoder program: decodes compressed frames and tries to read files for VICON, which asks over standard input.
// What breaks here breaks nothing else.
#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <new>
#include <optional>

#include "confinement.h"
#include "descriptor_stream.h"
#include "encoding.h"
#include "gdcm_codec.h"
#include "header_cost.h"
#include "helper_protocol.h"
#include "jpeg_codec.h"
#include "vicon/core/error.h"
#include "vicon/dicom/dicom_setup.h"

namespace vicon::ingest {
namespace {

struct Asked {
    HelperRequest request;
    int descriptor = -1;
};

/// The next question; nothing when nobody asks any more.
std::optional<Asked> nextRequest()
{
    Asked asked;
    iovec part{&asked.request, sizeof asked.request};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
    msghdr message{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    if (::recvmsg(STDIN_FILENO, &message, MSG_WAITALL | MSG_CMSG_CLOEXEC) != ssize_t(sizeof asked.request))
        return {};
    const cmsghdr* const header = CMSG_FIRSTHDR(&message);
    if (header && header->cmsg_level == SOL_SOCKET && header->cmsg_type == SCM_RIGHTS)
        std::memcpy(&asked.descriptor, CMSG_DATA(header), sizeof asked.descriptor);
    return asked;
}

bool receiveAll(std::string& bytes)
{
    for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t some = ::recv(STDIN_FILENO, bytes.data() + done, bytes.size() - done, 0);
        if (some == 0 || (some < 0 && errno != EINTR))
            return false;
        done += some > 0 ? std::size_t(some) : 0;
    }
    return true;
}

void sendAll(const char* bytes, std::size_t count)
{
    while (count > 0) {
        const ssize_t some = ::send(STDIN_FILENO, bytes, count, MSG_NOSIGNAL);
        if (some < 0 && errno != EINTR)
            ::_exit(1);
        bytes += some > 0 ? some : 0;
        count -= some > 0 ? std::size_t(some) : 0;
    }
}

void answer(HelperAnswer::Fate fate, const char* bytes, std::size_t count)
{
    const HelperAnswer head{fate, count};
    sendAll(reinterpret_cast<const char*>(&head), sizeof head);
    sendAll(bytes, count);
}

std::vector<char> decode(const HelperRequest& request, const std::string& stream)
{
    const PixelFormat format = pixelFormatOf(request);
    return isDecodedByGdcm(request.transfer_syntax) ? decodeWithGdcm(stream, format, request.transfer_syntax)
                                                    : decodeWithDcmtk(stream, format, request.transfer_syntax);
}

/// Adds what an item or sequence holds, not deeper than the parser went. In which order it was written is no longer
/// seen: the worst is assumed.
void count(DcmObject& container, HeaderCost& cost)
{
    ItemTally tally;
    for (DcmObject* next = container.nextInContainer(nullptr); next; next = container.nextInContainer(next)) {
        const DcmTagKey tag = next->getTag();
        const auto* const element = dynamic_cast<DcmElement*>(next);  // left in the file, a value costs nothing
        const bool own = next->isLeaf() && tag != DCM_PixelData && element && element->valueLoaded();
        constexpr Uint16 kItemGroup = 0xfffe;
        const std::string too_much = tag.getGroup() == kItemGroup
                                         ? cost.addPart()
                                         : cost.addElement(tally, {}, own ? next->getLengthField() : 0);
        if (!too_much.empty())
            throw Error(ErrorCode::bad_input, too_much);
        if (!next->isLeaf())
            count(*next, cost);
    }
}

/// Whether it is DICOM does not matter, only that reading it and giving it up again ends, in the memory there is.
void read(int descriptor)
{
    constexpr Uint32 kLargestElementInMemory = 16384;
    DescriptorStream stream(descriptor, 0);
    DcmFileFormat format;
    format.transferInit();
    const OFCondition loaded = format.read(stream, EXS_Unknown, EGL_noChange, kLargestElementInMemory);
    format.transferEnd();
    if (loaded == EC_MemoryExhausted)
        throw std::bad_alloc();
    HeaderCost cost;
    count(*format.getMetaInfo(), cost);
    count(*format.getDataset(), cost);
}

void serve(const Asked& asked)
{
    using Fate = HelperAnswer::Fate;
    std::string stream(asked.request.bytes, '\0');
    if (!receiveAll(stream))
        ::_exit(1);
    std::string why;
    try {
        std::vector<char> pixels;
        if (asked.request.kind == HelperRequest::Kind::read)
            read(asked.descriptor);
        else
            pixels = decode(asked.request, stream);
        return answer(Fate::done, pixels.data(), pixels.size());
    } catch (const std::bad_alloc&) {
        why = "it needs more memory than a decoder may take";
    } catch (const std::exception& e) {
        why = e.what();
    }
    why.resize(std::min(why.size(), kLongestReason));
    answer(Fate::failed, why.data(), why.size());
}

void run()
{
    setUpDicom();
    setUpJpeg();
    confine();
    while (const auto asked = nextRequest()) {
        limitProcessorTime(asked->request.cpu_seconds);
        serve(*asked);
        limitProcessorTime(0);
        if (asked->descriptor >= 0)
            ::close(asked->descriptor);
    }
}

}  // namespace
}  // namespace vicon::ingest

int main()
{
    vicon::ingest::run();
    ::_exit(0);  // nothing to tidy up, and what libraries do at their end may be out of reach
}
