#include "anonymous_profile.h"

#include <dcmtk/dcmdata/dcdeftag.h>
#include <dcmtk/dcmdata/dcuid.h>

#include <algorithm>
#include <map>

namespace vicon::ingest {
namespace {

using Tags = std::vector<DcmTagKey>;

const Tags& image()
{
    static const Tags kTags = {DCM_SpecificCharacterSet,
                               DCM_ImageType,
                               DCM_SOPClassUID,
                               DCM_Modality,
                               DCM_Manufacturer,
                               DCM_ManufacturerModelName,
                               DCM_BodyPartExamined,
                               DCM_Laterality,
                               DCM_PatientPosition,
                               DCM_SeriesNumber,
                               DCM_AcquisitionNumber,
                               DCM_InstanceNumber,
                               DCM_ImagePositionPatient,
                               DCM_ImageOrientationPatient,
                               DCM_SliceLocation,
                               DCM_SamplesPerPixel,
                               DCM_PhotometricInterpretation,
                               DCM_NumberOfFrames,
                               DCM_Rows,
                               DCM_Columns,
                               DCM_PixelSpacing,
                               DCM_PixelAspectRatio,
                               DCM_BitsAllocated,
                               DCM_BitsStored,
                               DCM_HighBit,
                               DCM_PixelRepresentation,
                               DCM_SmallestImagePixelValue,
                               DCM_LargestImagePixelValue,
                               DCM_PixelPaddingValue,
                               DCM_PixelPaddingRangeLimit,
                               DCM_BurnedInAnnotation,
                               DCM_WindowCenter,
                               DCM_WindowWidth,
                               DCM_VOILUTFunction,
                               DCM_RescaleIntercept,
                               DCM_RescaleSlope,
                               DCM_RescaleType,
                               DCM_LossyImageCompression,
                               DCM_LossyImageCompressionRatio,
                               DCM_LossyImageCompressionMethod,
                               DCM_PresentationLUTShape,
                               DCM_PixelData};
    return kTags;
}

const Tags& acquisition()
{
    static const Tags kTags = {DCM_ScanOptions,
                               DCM_ScanningSequence,
                               DCM_SequenceVariant,
                               DCM_MRAcquisitionType,
                               DCM_RepetitionTime,
                               DCM_EchoTime,
                               DCM_EchoTrainLength,
                               DCM_InversionTime,
                               DCM_FlipAngle,
                               DCM_MagneticFieldStrength,
                               DCM_SliceThickness,
                               DCM_SpacingBetweenSlices,
                               DCM_KVP,
                               DCM_DataCollectionDiameter,
                               DCM_ReconstructionDiameter,
                               DCM_DistanceSourceToDetector,
                               DCM_DistanceSourceToPatient,
                               DCM_GantryDetectorTilt,
                               DCM_TableHeight,
                               DCM_RotationDirection,
                               DCM_ExposureTime,
                               DCM_XRayTubeCurrent,
                               DCM_Exposure,
                               DCM_ExposureInuAs,
                               DCM_FilterType,
                               DCM_GeneratorPower,
                               DCM_FocalSpots,
                               DCM_ConvolutionKernel,
                               DCM_RevolutionTime,
                               DCM_SingleCollimationWidth,
                               DCM_TotalCollimationWidth,
                               DCM_TableSpeed,
                               DCM_TableFeedPerRotation,
                               DCM_SpiralPitchFactor,
                               DCM_DataCollectionCenterPatient,
                               DCM_ReconstructionTargetCenterPatient,
                               DCM_ExposureModulationType,
                               DCM_CTDIvol};
    return kTags;
}

/// Of Enhanced CT: its sequences, and what stands in them.
const Tags& functionalGroups()
{
    static const Tags kTags = {DCM_SharedFunctionalGroupsSequence,
                               DCM_PerFrameFunctionalGroupsSequence,
                               DCM_PixelMeasuresSequence,
                               DCM_PlanePositionSequence,
                               DCM_PlaneOrientationSequence,
                               DCM_FrameContentSequence,
                               DCM_FrameAnatomySequence,
                               DCM_FrameLaterality,
                               DCM_AnatomicRegionSequence,
                               DCM_CodeValue,
                               DCM_CodingSchemeDesignator,
                               DCM_CodeMeaning,
                               DCM_FrameVOILUTSequence,
                               DCM_PixelValueTransformationSequence,
                               DCM_CTImageFrameTypeSequence,
                               DCM_FrameType,
                               DCM_PixelPresentation,
                               DCM_VolumetricProperties,
                               DCM_VolumeBasedCalculationTechnique,
                               DCM_ContentQualification,
                               DCM_CTAcquisitionTypeSequence,
                               DCM_AcquisitionType,
                               DCM_TubeAngle,
                               DCM_ConstantVolumeFlag,
                               DCM_FluoroscopyFlag,
                               DCM_CTAcquisitionDetailsSequence,
                               DCM_CTTableDynamicsSequence,
                               DCM_CTPositionSequence,
                               DCM_TablePosition,
                               DCM_CTGeometrySequence,
                               DCM_DistanceSourceToDataCollectionCenter,
                               DCM_CTReconstructionSequence,
                               DCM_ReconstructionAlgorithm,
                               DCM_ConvolutionKernelGroup,
                               DCM_ReconstructionFieldOfView,
                               DCM_ReconstructionPixelSpacing,
                               DCM_ReconstructionAngle,
                               DCM_ImageFilter,
                               DCM_CTExposureSequence,
                               DCM_XRayTubeCurrentInmA,
                               DCM_ExposureInmAs,
                               DCM_ExposureTimeInms,
                               DCM_CTXRayDetailsSequence,
                               DCM_FilterMaterial,
                               DCM_FrameAcquisitionDuration,
                               DCM_FrameAcquisitionNumber,
                               DCM_AcquisitionDuration,
                               DCM_TemporalPositionIndex,
                               DCM_StackID,
                               DCM_InStackPositionNumber,
                               DCM_DimensionOrganizationSequence,
                               DCM_DimensionOrganizationType,
                               DCM_DimensionIndexSequence,
                               DCM_DimensionIndexPointer,
                               DCM_FunctionalGroupPointer,
                               DCM_DimensionIndexValues};
    return kTags;
}

const Tags& uids()
{
    static const Tags kTags = {DCM_StudyInstanceUID,   DCM_SeriesInstanceUID,   DCM_SOPInstanceUID,
                               DCM_AcquisitionUID,     DCM_FrameOfReferenceUID, DCM_DimensionOrganizationUID,
                               DCM_IrradiationEventUID};
    return kTags;
}

}  // namespace

const std::vector<DateAndTime>& anonymousMoments()
{
    static const std::vector<DateAndTime> kMoments = {{DCM_StudyDate, DCM_StudyTime},
                                                      {DCM_SeriesDate, DCM_SeriesTime},
                                                      {DCM_AcquisitionDate, DCM_AcquisitionTime},
                                                      {DCM_ContentDate, DCM_ContentTime},
                                                      {DCM_InstanceCreationDate, DCM_InstanceCreationTime}};
    return kMoments;
}

const std::vector<DcmTagKey>& anonymousDateTimes()
{
    static const Tags kTags = {DCM_AcquisitionDateTime, DCM_FrameReferenceDateTime, DCM_FrameAcquisitionDateTime};
    return kTags;
}

const std::vector<DcmTagKey>& requiredOfAnonymous(const std::string& sop_class)
{
    static const Tags kOfAll = {DCM_AccessionNumber,  DCM_ReferringPhysicianName,
                                DCM_PatientBirthDate, DCM_PatientSex,
                                DCM_StudyID,          DCM_StudyDate,
                                DCM_StudyTime};
    const auto ofSlices = [](std::initializer_list<DcmTagKey> own) {
        Tags tags = kOfAll;
        tags.insert(tags.end(), {DCM_PositionReferenceIndicator, DCM_Manufacturer, DCM_InstanceNumber, DCM_Laterality});
        tags.insert(tags.end(), own);
        return tags;
    };
    static const Tags kOfCt = ofSlices({DCM_KVP, DCM_AcquisitionNumber});
    static const Tags kOfMr =
        ofSlices({DCM_ScanOptions, DCM_MRAcquisitionType, DCM_RepetitionTime, DCM_EchoTime, DCM_EchoTrainLength});
    if (sop_class == UID_CTImageStorage)
        return kOfCt;
    return sop_class == UID_MRImageStorage ? kOfMr : kOfAll;
}

std::optional<AnonymousFate> anonymousFateOf(const DcmTagKey& tag)
{
    static const std::map<DcmTagKey, AnonymousFate> kFates = [] {
        std::map<DcmTagKey, AnonymousFate> fates;
        const auto add = [&](const Tags& tags, AnonymousFate fate) {
            for (const DcmTagKey& one : tags)
                fates[one] = fate;
        };
        add(image(), AnonymousFate::keep);
        add(acquisition(), AnonymousFate::keep);
        add(functionalGroups(), AnonymousFate::keep);
        add(uids(), AnonymousFate::uid);
        add({DCM_AccessionNumber, DCM_ReferringPhysicianName, DCM_PatientBirthDate, DCM_PatientSex, DCM_StudyID,
             DCM_PositionReferenceIndicator, DCM_ContrastBolusAgent, DCM_AcquisitionContextSequence},
            AnonymousFate::empty);
        add({DCM_DeviceSerialNumber, DCM_SoftwareVersions}, AnonymousFate::dummy);
        add(anonymousDateTimes(), AnonymousFate::time);
        for (const DateAndTime& moment : anonymousMoments())
            add({moment.date, moment.time}, AnonymousFate::time);
        return fates;
    }();
    const auto found = kFates.find(tag);
    return found == kFates.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace vicon::ingest
