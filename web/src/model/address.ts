// Spreadsheet addresses: columns A, B, …, Z, AA, …; rows 1, 2, …; both counted from 0 in code.

export interface Address {
    column: number;
    row: number;
}

export function columnName(column: number): string {
    let name = "";
    for (let left = column + 1; left > 0; left = Math.floor((left - 1) / 26)) {
        name = String.fromCharCode(65 + ((left - 1) % 26)) + name;
    }
    return name;
}

export function columnIndex(name: string): number {
    let index = 0;
    for (const letter of name.toUpperCase()) index = index * 26 + (letter.charCodeAt(0) - 64);
    return index - 1;
}

export function formatAddress(address: Address): string {
    return columnName(address.column) + String(address.row + 1);
}

/** null when the text is no address such as "B2". */
export function parseAddress(text: string): Address | null {
    const match = /^\s*([A-Za-z]{1,3})([1-9][0-9]{0,5})\s*$/.exec(text);
    if (!match) return null;
    return { column: columnIndex(match[1]!), row: Number(match[2]) - 1 };
}

/**
 * A formula as it reads after being copied by (columns, rows), as spreadsheets do: references move along unless fixed by "$".
 * References that would leave the sheet become #REF!.
 */
export function shiftFormula(formula: string, columns: number, rows: number): string {
    return formula.replace(
        /(\$?)([A-Za-z]{1,3})(\$?)([1-9][0-9]{0,5})(?![A-Za-z0-9_(])/g,
        (text: string, fixedColumn: string, column: string, fixedRow: string, row: string, at: number) => {
            const before = at > 0 ? formula.charAt(at - 1) : "";
            if (/[A-Za-z0-9_]/.test(before)) return text;
            const newColumn = columnIndex(column) + (fixedColumn ? 0 : columns);
            const newRow = Number(row) + (fixedRow ? 0 : rows);
            if (newColumn < 0 || newRow < 1) return "#REF!";
            return fixedColumn + columnName(newColumn) + fixedRow + String(newRow);
        },
    );
}
