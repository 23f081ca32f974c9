#include <sys/mman.h>
#include <unistd.h>

#include <optional>

#include "dataset.h"
#include "helper.h"
#include "same_object.h"
#include "study_key.h"
#include "vicon/core/error.h"
#include "vicon/dicom/dicom_setup.h"
#include "vicon/dicom/load_file.h"
#include "web_object.h"
#include "web_peer.h"

namespace fs = std::filesystem;

namespace vicon::ingest::web {
namespace {

/// A file that nobody else sees, and that is gone with this program.
class PrivateFile {
public:
    PrivateFile() : descriptor_(::memfd_create("read back", MFD_CLOEXEC)) {}
    ~PrivateFile() { ::close(descriptor_); }
    PrivateFile(const PrivateFile&) = delete;
    PrivateFile& operator=(const PrivateFile&) = delete;
    fs::path path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }
    void add(std::string_view bytes)
    {
        while (!bytes.empty()) {
            const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
            if (count <= 0)
                throw Error(ErrorCode::no_memory, "what the peer gives back cannot be held");
            bytes.remove_prefix(std::size_t(count));
            size_ += std::size_t(count);
        }
    }
    std::size_t size() const { return size_; }

private:
    int descriptor_;
    std::size_t size_ = 0;
};

/// Of a file of the store, which may be deflated.
ObjectUids uidsOfOurs(const fs::path& file)
{
    constexpr Uint32 kLargestElementInMemory = 16384;
    setUpDicom();
    DcmFileFormat format;
    if (loadFile(format, file, kLargestElementInMemory).bad())
        return {};
    const Dataset d(*format.getDataset());
    return {d.raw(DCM_StudyInstanceUID), d.raw(DCM_SeriesInstanceUID), d.raw(DCM_SOPInstanceUID),
            d.raw(DCM_SOPClassUID)};
}

}  // namespace

Kept readBack(const Peer& peer, const fs::path& file, Progress& progress)
{
    constexpr long kNotFound = 404, kGone = 410, kNoSuchMethod = 405, kNoSuchForm = 406, kNotImplemented = 501;
    // A peer may write its own meta header, and lengths in other words.
    const std::size_t most = 2 * fs::file_size(file) + (1U << 20U);
    const ObjectUids uids = uidsOfOurs(file);
    WebClient client(peer, progress);
    PrivateFile back;
    bool too_much = false;
    const FetchedObjects fetched = fetchObjects(client,
                                                "/studies/" + uidInPath(uids.study) + "/series/" +
                                                    uidInPath(uids.series) + "/instances/" + uidInPath(uids.object),
                                                {[] {},
                                                 [&](std::string_view bytes) {
                                                     too_much = too_much || back.size() + bytes.size() > most;
                                                     if (!too_much)
                                                         back.add(bytes);
                                                 },
                                                 [] {}});
    if (fetched.answer.status == kNotFound || fetched.answer.status == kGone)
        return Kept::missing;
    if (fetched.answer.status == kNoSuchMethod || fetched.answer.status == kNoSuchForm ||
        fetched.answer.status == kNotImplemented)
        return Kept::unsaid;
    client.requireGood(fetched.answer, "the peer does not give back what it took");
    if (fetched.count != 1 || too_much || !whyNotToRead(back.path()).empty())
        return Kept::changed;
    return isSameObject(file, back.path()) ? Kept::whole : Kept::changed;
}

}  // namespace vicon::ingest::web
