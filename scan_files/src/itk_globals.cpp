#include "vicon/scan_files/itk_globals.h"

#include <itkMetaImageIO.h>  // and DataObject
#include <itkMultiThreaderBase.h>

namespace vicon::scan_files {

void makeItkGlobals()
{
    [[maybe_unused]] static const bool made = [] {
        itk::MetaImageIO::New();
        itk::MultiThreaderBase::GetGlobalMaximumNumberOfThreads();
        itk::DataObject::GetGlobalReleaseDataFlag();
        itk::Object::GetGlobalWarningDisplay();
        return true;
    }();
}

}  // namespace vicon::scan_files
