"""From a case to a record: the facts that the faces show."""
