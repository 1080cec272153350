/** Files: given to the user, and had from the server. */

/** Offers bytes as a download. */
export function offer(name: string, content: Blob): void {
  const address = URL.createObjectURL(content);
  const link = document.createElement("a");
  link.href = address;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}

export interface ExportWish {
  readonly what: string;
  readonly format: string;
  readonly case?: unknown;
  readonly parameters?: Readonly<Record<string, unknown>>;
}

/** Has the server write a file and offers it; returns the one line that says what was wrong, or null. */
export async function exportFile(wish: ExportWish): Promise<string | null> {
  try {
    const answer = await fetch("/export", {
      method: "POST",
      headers: { "Content-Type": "application/json" },
      body: JSON.stringify(wish),
    });
    if (!answer.ok) return await complaint(answer);
    const given = /filename="([^"]+)"/.exec(answer.headers.get("Content-Disposition") ?? "");
    offer(given?.[1] ?? `${wish.what}.${wish.format}`, await answer.blob());
    return null;
  } catch {
    return "the server did not answer; is palmar studio still running?";
  }
}

async function complaint(answer: Response): Promise<string> {
  const found = (await answer.json().catch(() => null)) as { error?: unknown } | null;
  return typeof found?.error === "string" ? found.error : `the server answered ${answer.status}`;
}
