#pragma once

#include <map>
#include <string>
#include <vector>

#include "scan_assembly.h"
#include "study_objects.h"

namespace vicon::ingest {

/// Takes the objects of one study into its case.
class StudyImport {
public:
    explicit StudyImport(const ImportContext& context) : context_(context) {}
    /// @param arrivals of one study, in the order in which they were found
    /// @param notes by Series Instance UID
    void run(std::vector<Arrival> arrivals, std::map<std::string, SeriesNotes>& notes);

private:
    /// What of a scan is not as it is recorded.
    struct Changes {
        bool grew = false, role = false, hashes = false;
    };
    void describe(AssembledScan& scan, const std::map<std::string, SeriesNotes>& notes) const;
    void addNotes(AssembledScan& scan, const std::map<std::string, SeriesNotes>& notes) const;
    void store(const AssembledScan& scan);
    Changes changesOf(const AssembledScan& scan, const std::vector<InstanceRecord>& instances, bool has_copies) const;
    /// Records a scan that changed or is told of otherwise. @return the flag that its case got; empty for none
    std::string record(const AssembledScan& scan, const std::vector<InstanceRecord>& instances, const Changes& changes);
    void requireNoReaderInput(const AssembledScan& scan) const;
    void tell(const AssembledScan& scan, bool changed) const;
    void tellMissing() const;
    void removeEmptied() const;

    const ImportContext& context_;
    StoredStudy stored_;
    std::vector<AssembledScan> scans_;
};

}  // namespace vicon::ingest
