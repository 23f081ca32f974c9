#pragma once

#include <map>
#include <set>
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
    /// Takes arrivals, in the order in which they were found. Other content under a known UID is refused, unless what
    /// is stored under it is lost or damaged; another patient's objects go into quarantine.
    void admit(std::vector<Arrival> arrivals);
    /// A scan is decoded when it is processed; what will not be processed, or looks damaged, is proven here.
    void dropUndecodable();
    /// Refuses the arrivals that are in no scan: whoever acknowledged them keeps them.
    /// @param taken what is in one
    void refuseAllBut(const std::set<const ImageObject*>& taken);
    /// By SOP Instance UID.
    const std::map<std::string, ImageObject>& all() const { return objects_; }

private:
    /// What a recorded file is found to be.
    enum class Recorded { whole, lost, unreadable };

    void forgetDamaged(const std::vector<Arrival>& arrivals);
    std::string whyNotTaken(const ImageObject& object);
    std::filesystem::path fileOf(const InstanceRecord& recorded) const;
    Recorded stateOf(const InstanceRecord& recorded) const;
    void tellReplaced() const;
    void refuse(const ImageObject& object, const std::string& shown, const std::string& why);

    const ImportContext& context_;
    StoredStudy& stored_;
    std::map<std::string, SeriesNotes>& notes_;
    std::map<std::string, ImageObject> objects_;
    std::map<std::string, std::string> shown_;     ///< of arrivals, by SOP Instance UID
    std::map<std::string, std::size_t> replaced_;  ///< lost or damaged objects, by Series Instance UID
};

}  // namespace vicon::ingest
