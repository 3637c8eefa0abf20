#include "services/store/compiled_statements.h"

namespace trailcast::store {

CompiledStatements::Lease CompiledStatements::Take(std::string_view sql) {
  auto found = statements_.find(sql);
  if (found == statements_.end()) {
    const std::string text(sql);
    found = statements_.try_emplace(text, db_, text).first;
  } else {
    found->second.clearBindings();
  }
  return Lease(found->second);
}

}  // namespace trailcast::store
