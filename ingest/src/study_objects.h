#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "stored_study.h"

namespace vicon::ingest {

/// An object that came in, and how the user knows its file.
struct Arrival {
    ImageObject object;
    std::string shown;
    bool unpacked = false;  ///< out of a zip file: nobody else has it
};

/// The objects of a study: those that the store has, and the arrivals that are taken.
class StudyObjects {
public:
    /// @param stored whose objects go over to this
    /// @param notes of all series, by Series Instance UID; what is refused is noted there
    StudyObjects(const ImportContext& context, StoredStudy& stored, std::map<std::string, SeriesNotes>& notes)
        : context_(context), stored_(stored), notes_(notes), objects_(std::move(stored.objects))
    {
    }
    /// Takes arrivals, in the order in which they were found. Other content under a known UID is refused; another
    /// patient's objects go into quarantine.
    void admit(std::vector<Arrival> arrivals);
    /// A scan is decoded when it is processed; what will not be processed, or looks damaged, is proven here.
    void dropUndecodable();
    /// By SOP Instance UID.
    const std::map<std::string, ImageObject>& all() const { return objects_; }

private:
    bool isSameAsStored(const ImageObject& object, const std::optional<InstanceRecord>& recorded) const;
    void refuse(const ImageObject& object, const std::string& shown, const std::string& why);

    const ImportContext& context_;
    StoredStudy& stored_;
    std::map<std::string, SeriesNotes>& notes_;
    std::map<std::string, ImageObject> objects_;
    std::map<std::string, std::string> shown_;  ///< of arrivals, by SOP Instance UID
};

}  // namespace vicon::ingest
