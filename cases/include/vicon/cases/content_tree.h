#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/records.h"
#include "vicon/core/geometry.h"

namespace vicon {

// A structured report (DICOM PS3.3 C.17.3) as it stands, without what it means: who reads the file and who understands
// the report need not know each other. Texts are UTF-8.

/// A concept by DICOM's coding.
struct CodedConcept {
    std::string value, scheme, meaning;
};

/// Another object that a report refers to.
struct ObjectReference {
    std::string sop_class, sop_uid;
};

/// A node of the tree. What its value type does not have is empty.
struct ContentItem {
    std::string relation;  ///< to the node above: "CONTAINS", ...; of the root empty
    std::string type;      ///< "CONTAINER", "TEXT", "NUM", "CODE", "UIDREF", "IMAGE", "SCOORD3D", ...
    CodedConcept name;
    CodedConcept code;             ///< of CODE the value, of NUM the unit
    std::string text;              ///< of TEXT, PNAME, UIDREF, DATE, TIME, DATETIME
    std::optional<double> number;  ///< of NUM
    ObjectReference reference;     ///< of IMAGE, COMPOSITE, WAVEFORM
    std::string graphic;           ///< of SCOORD3D: "POINT", "POLYLINE", ...
    std::vector<Point3> points_mm;
    std::string frame_of_reference_uid;
    std::vector<ContentItem> children;
};

/// A structured report: whose it is, what it is, and its tree.
struct ContentDocument {
    std::string sop_class, sop_uid, series_uid;
    Patient patient;
    Study study;
    std::string maker;   ///< Manufacturer, and its model
    std::string date;    ///< YYYYMMDD, when its content was made
    std::string person;  ///< who verified it; else who wrote it; empty: not said
    bool verified = false;
    std::vector<std::string> replaces;  ///< SOP Instance UIDs of earlier versions
    /// What it refers to, by SOP Instance UID, and the series that it says that lies in.
    std::map<std::string, std::string> evidence;
    ContentItem root;
    std::vector<std::string> not_read;  ///< what could not be read of it, a line each
};

}  // namespace vicon
