// The whole state of the page, put together from its slices.
import { noBook, reduceBook, type BookAction, type BookSlice } from "./book";
import { noConnection, reduceConnection, type ConnectionAction, type ConnectionState } from "./connection";
import { noLevels, reduceLevels, type LevelAction, type LevelSlice } from "./levels";
import { newPage, reducePage, type PageAction, type PageSlice } from "./page";
import { Store } from "./store";
import { reduceTiles, type TileAction, type TileSlice } from "./tiles";

export interface AppState {
    connection: ConnectionState;
    book: BookSlice;
    tiles: TileSlice;
    page: PageSlice;
    levels: LevelSlice;
}

export type AppAction = ConnectionAction | BookAction | TileAction | PageAction | LevelAction;
export type AppStore = Store<AppState, AppAction>;

export function reduceApp(state: AppState, action: AppAction): AppState {
    const slice = action.type.slice(0, action.type.indexOf("/"));
    switch (slice) {
        case "connection": {
            const connection = reduceConnection(state.connection, action as ConnectionAction);
            return connection === state.connection ? state : { ...state, connection };
        }
        case "book": {
            const book = reduceBook(state.book, action as BookAction);
            return book === state.book ? state : { ...state, book };
        }
        case "tiles":
            return { ...state, tiles: reduceTiles(state.tiles, action as TileAction) };
        case "levels": {
            const levels = reduceLevels(state.levels, action as LevelAction);
            return levels === state.levels ? state : { ...state, levels };
        }
        default: {
            const page = reducePage(state.page, action as PageAction);
            return page === state.page ? state : { ...state, page };
        }
    }
}

export function newAppStore(): AppStore {
    return new Store<AppState, AppAction>(
        { connection: noConnection, book: noBook, tiles: {}, page: newPage, levels: noLevels },
        reduceApp,
    );
}
