// What this browser keeps of a person's choices. It keeps nothing where storage is forbidden; a choice then holds until
// the page is loaded again.
export function kept<Choice extends string>(key: string, choices: Record<Choice, string>, otherwise: Choice): Choice {
  try {
    const choice = window.localStorage.getItem(key) ?? '';
    return choice in choices ? (choice as Choice) : otherwise;
  } catch {
    return otherwise;
  }
}

export function keep(key: string, choice: string) {
  try {
    window.localStorage.setItem(key, choice);
  } catch {
    // See above.
  }
}
