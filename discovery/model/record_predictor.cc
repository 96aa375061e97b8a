#include "discovery/model/record_predictor.h"

#include "discovery/model/response_predictor.h"
#include "discovery/model/static_predictor.h"

namespace ambrig {

std::unique_ptr<RecordPredictor> MakePredictor(const Case& c, const CaseRecord& record) {
  if (record.kind == RecordKind::kFrf) return std::make_unique<ResponsePredictor>(c, record);
  if (record.kind == RecordKind::kStatic) return std::make_unique<StaticPredictor>(c, record);
  return nullptr;
}

}  // namespace ambrig
