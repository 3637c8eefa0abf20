// The photos that a mission takes on its way, as a form has them.
export type Asked = { every: string; at: string };
export const noPhotos: Asked = { every: '', at: '' };

const placesIn = (text: string) => text.split(/[\s,]+/).filter((word) => word !== '');

// As the API has them.
export type PhotosBody = { photo_every_m?: number; photo_at?: string[] };
export function bodyOf({ every, at }: Asked): PhotosBody {
  const places = placesIn(at);
  return { ...(every === '' ? {} : { photo_every_m: Number(every) }), ...(places.length === 0 ? {} : { photo_at: places }) };
}

const asks = /^((?:goto \S+(?: way \d+(?: queued| admitted)?)?)?) ?photo(?: every (\S+))?((?: at \S+)*)(?: |$)/;

// Takes the words that ask for photos out of orders.
export function apart(orders: string): { orders: string; asked: Asked } {
  const found = asks.exec(orders);
  if (!found) return { orders, asked: noPhotos };
  const [all, goal, every = '', at] = found;
  return {
    orders: [goal, orders.slice(all.length)].filter((part) => part !== '').join(' '),
    asked: { every, at: placesIn(at).filter((word) => word !== 'at').join(', ') },
  };
}
