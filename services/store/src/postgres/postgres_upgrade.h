#pragma once

#include <pqxx/pqxx>

namespace trailcast::store {

// Makes the tables of version 2, which kept what is known of a route column by column and receipts
// in the segments' rows, those of today. In the caller's transaction, which has the makers' lock.
// What was damaged stays damaged.
void BringUpFrom2(pqxx::transaction_base& transaction);

}  // namespace trailcast::store
