// Demonstrations that the browser keeps, to look at, use again, export and import.

import { byId, freshName, make, short } from "./dom";
import { keep, kept } from "./keep";
import { FromPage, Imported } from "./protocol";
import { Take, assess, duration } from "./take";

interface Entry {
  name: string;
  take: Take;
}

export class Library {
  private entries: Entry[] = kept<Entry[]>("library", []);

  /**
   * @param open Makes an entry the present take.
   * @param undoable Is given what would undo a removal.
   */
  constructor(
    private readonly send: (message: FromPage) => boolean,
    private readonly open: (take: Take) => void,
    private readonly undoable: (undo: () => void) => void,
  ) {
    byId("export").onclick = () => this.export();
    byId<HTMLInputElement>("import").onchange = (event) => {
      const input = event.target as HTMLInputElement;
      const file = input.files?.[0];
      if (file) void file.text().then((text) => this.send({ what: "import", text }));
      input.value = "";
    };
    this.draw();
  }

  add(take: Take, name: string): void {
    this.change([...this.entries, { name, take: { ...take, id: freshName() } }]);
  }

  imported(message: Imported): void {
    const added = message.takes.map(({ take, samples }) => ({
      name: `${message.teacher} ${take}`,
      take: { id: freshName(), samples, raw: [], start: 0, end: 1, speed: 1, goal: null, seconds: 0 },
    }));
    this.change([...this.entries, ...added]);
  }

  exported(text: string): void {
    const link = make("a", {
      href: URL.createObjectURL(new Blob([text], { type: "application/json" })),
      download: "demonstrations.json",
    }) as HTMLAnchorElement;
    link.click();
    window.setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }

  private export(): void {
    if (!this.entries.length) return;
    for (const { take } of this.entries) this.send(assess(take));
    this.send({ what: "export", takes: this.entries.map(({ take }) => take.id) });
  }

  private change(entries: Entry[]): void {
    this.entries = entries.slice(-100);
    keep("library", this.entries);
    this.draw();
  }

  private draw(): void {
    byId<HTMLButtonElement>("export").disabled = !this.entries.length;
    byId("library").replaceChildren(
      ...this.entries.map((entry) => {
        const show = make("button", {}, "Show");
        const remove = make("button", { "aria-label": `Remove ${entry.name}` }, "×");
        show.onclick = () => this.open(entry.take);
        remove.onclick = () => {
          const before = this.entries;
          this.undoable(() => this.change(before));
          this.change(this.entries.filter((one) => one !== entry));
        };
        const length = `${short(duration(entry.take))} s`;
        return make("li", {}, make("span", {}, entry.name), make("em", {}, length), show, remove);
      }),
      ...(this.entries.length ? [] : [make("li", { class: "hint" }, "Nothing kept yet.")]),
    );
  }
}
