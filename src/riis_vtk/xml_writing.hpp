// SPDX-License-Identifier: Apache-2.0
// In: a data set. Out: a VTK XML file that is complete or not there. Its data is raw and appended, which is as fast as the disk
// and keeps every bit of every double. Block sizes have 64 bits, since VTK's default ends at 4 GiB.
#pragma once

#include <string>

#include <vtkErrorCode.h>
#include <vtkNew.h>

#include "riis_vtk/files.hpp"
#include "riis_vtk/vtk_errors.hpp"

class vtkDataObject;

namespace riis::vtk {

template <class Writer>
void write_xml(const std::string &path, const std::string &ending, vtkDataObject *data, const CaughtOutput &caught) {
  if (ending_of(path) != ending) fail_file(path, "the file's ending must be ." + ending);
  ReplacingFile file(path);
  vtkNew<Writer> writer;
  writer->SetFileName(file.temporary().c_str());
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToNone();
  writer->SetHeaderTypeToUInt64();
  const bool written = writer->Write() != 0;
  if (writer->GetErrorCode() != vtkErrorCode::NoError) {
    fail_file(path, std::string("cannot be written: ") + vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode()));
  }
  caught.check(path);
  if (!written) fail_file(path, "cannot be written");
  file.commit("</VTKFile>");
}

}  // namespace riis::vtk
