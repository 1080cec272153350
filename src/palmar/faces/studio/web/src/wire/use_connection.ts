/** The page's one connection, for as long as the page is there. */

import { useState, useSyncExternalStore } from "react";
import { Connection, serverAddress, type Status } from "./connection";
import type { Hello } from "./hello";

export function useConnection(): readonly [Connection, Status, Hello | null] {
  const [connection] = useState(() => new Connection(serverAddress()));
  const status = useSyncExternalStore(connection.subscribe, () => connection.status);
  const hello = useSyncExternalStore(connection.subscribe, () => connection.hello);
  return [connection, status, hello];
}
