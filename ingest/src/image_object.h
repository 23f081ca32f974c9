#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/records.h"
#include "vicon/core/geometry.h"

namespace vicon::ingest {

/// How the pixels of an object are stored. Stored values are the `bits_stored` bits below and with `high_bit`.
struct PixelFormat {
    int rows = 0;
    int columns = 0;
    int bits_allocated = 0;
    int bits_stored = 0;
    int high_bit = 0;
    bool is_signed = false;
    int frames = 1;
    std::optional<std::pair<int, int>> padding;  ///< lowest and highest stored value that means "not measured"
    /// A padding value that does not fit the stored bits: all bits of a pixel, as they are allocated.
    std::optional<std::uint16_t> padding_cell;

    friend bool operator==(const PixelFormat&, const PixelFormat&) = default;
};

/// One image plane: the image of an object, or a frame of a multi-frame one.
struct Slice {
    int frame = 0;        ///< from 0
    Point3 position_mm;   ///< centre of the first pixel
    Vector3 row;          ///< unit vector along a row: column index grows
    Vector3 column;       ///< unit vector along a column: row index grows
    double pixel_mm = 0;  ///< between the pixels of a row
    double row_mm = 0;    ///< between rows
    double slope = 1;     ///< HU = slope * stored value + intercept; of MR the signal, see readSignal()
    double intercept = 0;
    double thickness_mm = 0;
    std::string image_type;  ///< values 1 to 4 joined by backslashes
    std::string kernel;
    std::string acquisition;  ///< acquisition number, empty: not said
    std::string phase;        ///< stack and temporal position, where a multi-frame object says them

    Vector3 normal() const { return cross(row, column); }
};

/// What VICON needs to know of a CT or MR object, from its header.
struct ImageObject {
    std::filesystem::path file;
    std::string sop_uid;
    std::string sop_class;
    std::string sha256;
    std::string sender;  ///< application entity title, where whoever wrote the file knew it
    Patient patient;
    Study study;
    Series series;
    std::string acquisition_uid;
    std::string acquisition_time;  ///< date and time as written, empty: not said
    std::string transfer_syntax;   ///< UID
    PixelFormat pixels;
    /// The compressed pixels do not begin and end as their encoding does: they must be decoded before they are trusted.
    bool doubtful = false;
    /// Behind the pixels, at the end of the file, what is no element.
    std::uint64_t trailing_bytes = 0;
    std::vector<Slice> slices;
    std::vector<std::string> repairs;  ///< what had to be assumed, without a patient's name
};

/// What a file turned out to be.
struct Inspection {
    enum class Verdict { image, report, set_aside, refused, directory, archive };
    Verdict verdict = Verdict::refused;
    std::string reason;  ///< of set_aside and refused
    /// Complete for an image; of a report with its patient and study; of other DICOM objects only the UIDs, as far as
    /// they could be read.
    ImageObject object;
};

}  // namespace vicon::ingest
