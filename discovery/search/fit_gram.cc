#include "discovery/search/fit_gram.h"

namespace ambrig {

RecordSubset FittedRecords(const CaseModel& model, const FitOptions& options) {
  const std::vector<CaseRecord>& records = model.data().records;
  RecordSubset look{std::vector<char>(records.size(), 0), std::vector<double>(model.size(), 0.0)};
  for (std::size_t r = 0; r < records.size(); ++r)
    look.records[r] = !records[r].validate && (options.records.empty() || options.records[r]);
  return look;
}

Eigen::MatrixXd FitGram(const CaseModel& model, const RecordSubset& look, const Eigen::MatrixXd& J,
                        const std::vector<double>& r) {
  const Eigen::Index p = J.cols();
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(p + 1, p + 1);
  for (const Target& t : model.targets()) {
    if (!look.records[t.record]) continue;
    const auto rows =
        J.middleRows(static_cast<Eigen::Index>(t.first), static_cast<Eigen::Index>(t.count));
    const Eigen::Map<const Eigen::VectorXd> part(r.data() + t.first,
                                                 static_cast<Eigen::Index>(t.count));
    gram.topLeftCorner(p, p).noalias() += rows.transpose() * rows;
    gram.topRightCorner(p, 1).noalias() += rows.transpose() * part;
    gram(p, p) += part.squaredNorm();
  }
  gram.bottomLeftCorner(1, p) = gram.topRightCorner(p, 1).transpose();
  return gram;
}

}  // namespace ambrig
