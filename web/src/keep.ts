// What the browser keeps, so that a reload or a server that starts again loses nothing.

/** Something kept under a name; anything unreadable counts as absent. */
export function kept<T>(name: string, absent: T): T {
  try {
    const text = localStorage.getItem(`sgim.${name}`);
    return text === null ? absent : (JSON.parse(text) as T);
  } catch {
    return absent;
  }
}

/** Keep something; a full store is no reason to stop a person who is drawing. */
export function keep(name: string, value: unknown): void {
  try {
    if (value === null) localStorage.removeItem(`sgim.${name}`);
    else localStorage.setItem(`sgim.${name}`, JSON.stringify(value));
  } catch {
    // Private windows and full stores keep nothing.
  }
}

/** This page's name: one for each tab, the same after a reload. */
export function pageName(fresh: () => string): string {
  try {
    const known = sessionStorage.getItem("sgim.page");
    if (known) return known;
    const name = fresh();
    sessionStorage.setItem("sgim.page", name);
    return name;
  } catch {
    return fresh();
  }
}
