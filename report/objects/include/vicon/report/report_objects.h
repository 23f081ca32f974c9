#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vicon/cases/case_store.h"
#include "vicon/cases/report_content.h"
#include "vicon/cases/report_versions.h"
#include "vicon/picture/png_file.h"

namespace vicon::report {

/// The forms that a report takes in a PACS.
enum class ObjectKind {
    pdf,           ///< Encapsulated PDF
    measurements,  ///< Comprehensive 3D SR, TID 1500
    key_images,    ///< Key Object Selection of the slices that show findings
    lumen,         ///< Segmentation, one of each scan
    picture,       ///< Secondary Capture, one of each sight of a finding, with its pictures side by side
};
inline const std::vector<ObjectKind> kAllObjects{ObjectKind::pdf, ObjectKind::measurements, ObjectKind::key_images,
                                                 ObjectKind::lumen, ObjectKind::picture};
/// "pdf", "sr", "key", "lumen", "picture".
std::string nameOf(ObjectKind kind);
/// Throws Error{wrong_use} for another name.
ObjectKind objectKindNamed(const std::string& name);

/// The SOP Instance UID of a version's object. It follows from the version's digest: the same report makes the same
/// objects.
/// @param which of several of a kind: the scan, the picture
std::string objectUid(const ReportVersion& version, ObjectKind kind, const std::string& which = {});

struct ReportObject {
    ObjectKind kind = ObjectKind::pdf;
    std::string sop_class, sop_uid;
    std::filesystem::path file;
};

/// The pictures of one sight of a finding. They do not say whose they are: the object's header does.
struct SightPictures {
    std::string marker_id;
    std::string what;  ///< in words
};

/// Pictures on their way into objects: those of a sight are joined and compressed on a thread of its own as soon as
/// they are there, while others are still drawn.
class PackedSights {
public:
    PackedSights();
    /// Waits for what is under way.
    ~PackedSights();
    PackedSights(const PackedSights&) = delete;
    PackedSights& operator=(const PackedSights&) = delete;

    /// Any thread may call it, once for each marker.
    /// @param pictures from left to right; at least one
    void begin(const std::string& marker_id, std::vector<picture::SharedPicture> pictures);

    struct Packed;
    /// Waits for it. Throws what went wrong. To be called once for each marker that was begun.
    std::unique_ptr<Packed> take(const std::string& marker_id);

private:
    struct Work;
    std::unique_ptr<Work> work_;
};

/// What objects are made of.
struct ObjectContent {
    const ReadCase& read;
    const ReportVersion& version;
    std::optional<ReportVersion> amended;  ///< the version that this one takes the place of
    std::string_view pdf;
    std::vector<SightPictures> pictures = {};
    std::vector<ObjectKind> kinds = kAllObjects;  ///< that are made
    PackedSights* packed = nullptr;               ///< where all the pictures were begun; none where there are none
};

/// What a report's objects show of its scans: where the images lie, the centrelines, the lumen on the images. It takes
/// a second a scan and needs no version, so it is made on other threads while the PDF is drawn.
class ShownScans {
public:
    /// Begins. What is not asked for is not made.
    ShownScans(CaseStore& store, const ReadCase& read, const std::vector<ObjectKind>& kinds = kAllObjects);
    /// Waits.
    ~ShownScans();
    ShownScans(const ShownScans&) = delete;
    ShownScans& operator=(const ShownScans&) = delete;

    struct Parts;
    /// Waits. Throws what went wrong.
    Parts& parts();

private:
    struct Work;
    std::unique_ptr<Work> work_;
};

/// Writes a report's objects into a folder, as version-N-KIND.dcm or version-N-KIND-WHICH.dcm; each kind is a series of
/// its own in the study that the report is about. Without findings in source images there are no key images, and a scan
/// whose images do not say where they lie has no segmentation. Dates are UTC and say so; texts are UTF-8. Throws
/// Error{store}.
std::vector<ReportObject> writeReportObjects(ShownScans& shown, const ObjectContent& content,
                                             const std::filesystem::path& folder);

}  // namespace vicon::report
