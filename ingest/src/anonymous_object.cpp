#include "anonymous_object.h"

#include <dcmtk/dcmdata/dcpixseq.h>
#include <dcmtk/dcmdata/dcpxitem.h>

#include <algorithm>
#include <vector>

#include "anonymous_profile.h"
#include "dataset.h"
#include "image_classes.h"
#include "stream_comments.h"
#include "vicon/core/error.h"

namespace vicon::ingest {
namespace {

void setText(DcmItem& item, const DcmTagKey& tag, const std::string& value)
{
    if (item.putAndInsertString(tag, value.c_str()).bad())
        throw Error(ErrorCode::bad_input, "an attribute cannot be written", DcmTag(tag).getTagName());
}

std::string joined(const std::vector<std::string>& values)
{
    std::string out;
    for (const std::string& value : values)
        out += (out.empty() ? "" : "\\") + value;
    return out;
}

class Cleaning {
public:
    explicit Cleaning(const Pseudonyms& pseudonyms) : pseudonyms_(pseudonyms) {}

    void clean(DcmItem& item) const
    {
        moveTimes(item);
        std::vector<DcmTagKey> tags;
        for (DcmObject* next = item.nextInContainer(nullptr); next; next = item.nextInContainer(next))
            tags.push_back(next->getTag().getXTag());
        for (const DcmTagKey& tag : tags)
            cleanElement(item, tag);
    }

private:
    void cleanElement(DcmItem& item, const DcmTagKey& tag) const
    {
        DcmElement* element = nullptr;
        if (item.findAndGetElement(tag, element).bad())
            return;
        const auto fate = anonymousFateOf(tag);
        const bool unread = element->ident() == EVR_UN && DcmTag(tag).getEVR() == EVR_SQ;  // items nobody looked into
        if (!fate || unread) {
            delete item.remove(tag);
        } else if (*fate == AnonymousFate::uid) {
            std::vector<std::string> values = Dataset(item).values(tag);
            for (std::string& value : values)
                value = pseudonyms_.uid(value);
            setText(item, tag, joined(values));
        } else if (*fate == AnonymousFate::empty) {
            item.insertEmptyElement(tag, OFTrue);
        } else if (*fate == AnonymousFate::dummy) {
            setText(item, tag, "anonymous");
        } else if (element->ident() == EVR_SQ) {
            for (DcmObject* next = element->nextInContainer(nullptr); next; next = element->nextInContainer(next))
                clean(static_cast<DcmItem&>(*next));
        }
    }

    void moveTimes(DcmItem& item) const
    {
        const Dataset read(item);
        for (const DateAndTime& tags : anonymousMoments()) {
            if (!item.tagExists(tags.date) && !item.tagExists(tags.time))
                continue;
            const auto moment = pseudonyms_.earlier(read.raw(tags.date), read.raw(tags.time));
            setText(item, tags.date, moment.date);
            setText(item, tags.time, moment.time);
        }
        for (const DcmTagKey& tag : anonymousDateTimes())
            if (item.tagExists(tag))
                setText(item, tag, pseudonyms_.earlier(read.raw(tag)));
    }

    const Pseudonyms& pseudonyms_;
};

/// Compressed streams may carry words of their own.
void blankStreams(DcmDataset& dataset)
{
    DcmElement* element = nullptr;
    DcmPixelSequence* sequence = nullptr;
    if (dataset.findAndGetElement(DCM_PixelData, element).bad() ||
        !DcmXfer(dataset.getOriginalXfer()).isEncapsulated() ||
        static_cast<DcmPixelData*>(element)
            ->getEncapsulatedRepresentation(dataset.getOriginalXfer(), nullptr, sequence)
            .bad())
        return;
    DcmObject* next = sequence->nextInContainer(nullptr);  // the table of offsets
    while (next && (next = sequence->nextInContainer(next))) {
        auto& fragment = static_cast<DcmPixelItem&>(*next);
        Uint8* bytes = nullptr;
        if (fragment.getUint8Array(bytes).good() && bytes)
            blankComments({bytes, fragment.getLength()});
    }
}

void sayHow(DcmDataset& dataset)
{
    setText(dataset, DCM_PatientIdentityRemoved, "YES");
    setText(dataset, DCM_DeidentificationMethod, "PS3.15 Basic Profile: what is not listed as harmless is removed");
    setText(dataset, DCM_LongitudinalTemporalInformationModified, "MODIFIED");
    struct Code {
        const char *value, *meaning;
    };
    // DICOM PS3.16 CID 7050
    constexpr Code kCodes[] = {{"113100", "Basic Application Confidentiality Profile"},
                               {"113107", "Retain Longitudinal Temporal Information Modified Dates Option"}};
    for (const Code& code : kCodes) {
        DcmItem* item = nullptr;
        constexpr long kAppend = -2;
        dataset.findOrCreateSequenceItem(DCM_DeidentificationMethodCodeSequence, item, kAppend);
        setText(*item, DCM_CodeValue, code.value);
        setText(*item, DCM_CodingSchemeDesignator, "DCM");
        setText(*item, DCM_CodeMeaning, code.meaning);
    }
}

/// An overlay in unused bits of the pixels, as objects before 2004 have it.
bool hasOverlayInPixels(DcmDataset& dataset)
{
    constexpr Uint16 kFirstGroup = 0x6000, kLastGroup = 0x601E, kBitsAllocated = 0x0100;
    for (Uint16 group = kFirstGroup; group <= kLastGroup; group = Uint16(group + 2))
        if (Dataset(dataset).integer(DcmTagKey(group, kBitsAllocated)).value_or(1) > 1)
            return true;
    return false;
}

}  // namespace

std::string whyNotAnonymous(DcmDataset& dataset)
{
    const Dataset read(dataset);
    const std::string sop_class = read.raw(DCM_SOPClassUID), modality = read.raw(DCM_Modality);
    if (!(isCtClass(sop_class) && modality == "CT") && !(isMrClass(sop_class) && modality == "MR"))
        return "no image of CT or MR";
    if (read.raw(DCM_BurnedInAnnotation) == "YES")
        return "text burnt into its pixels";
    for (const std::string& value : read.values(DCM_ImageType))
        if (value == "SCREEN SAVE" || value.starts_with("DOSE"))
            return "a page, not a slice";
    if (read.has(DCM_ConversionType) || !read.has(DCM_PixelData))
        return "a page, not a slice";
    return hasOverlayInPixels(dataset) ? "an overlay in its pixels" : "";
}

void makeAnonymous(DcmDataset& dataset, const Pseudonyms& pseudonyms, const NewUids& uids)
{
    Cleaning(pseudonyms).clean(dataset);
    blankStreams(dataset);
    setText(dataset, DCM_StudyInstanceUID, pseudonyms.uid(uids.study));
    setText(dataset, DCM_SeriesInstanceUID, pseudonyms.uid(uids.series));
    setText(dataset, DCM_SOPInstanceUID, pseudonyms.uid(uids.object));
    setText(dataset, DCM_PatientName, pseudonyms.patient());
    setText(dataset, DCM_PatientID, pseudonyms.patient());
    for (const DcmTagKey& tag : requiredOfAnonymous(Dataset(dataset).raw(DCM_SOPClassUID)))
        if (!dataset.tagExists(tag))
            dataset.insertEmptyElement(tag);
    sayHow(dataset);
}

}  // namespace vicon::ingest
